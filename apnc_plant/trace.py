"""Rows of numbers taken once per tick: cheap while the robot walks, split by name afterwards."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from apnc_core.types import Array

Split = Callable[[Array], Mapping[str, Array]]

CHUNK: Final = 1024
"""Rows allocated at a time."""


class Trace:
    """A table with one row per tick, which grows as it goes.

    Args:
        parts: arrays whose entries, one after the other, are a row; read anew at every tick.
        split: makes signals of rows of shape (ticks, width), row by row.
    """

    def __init__(self, parts: Sequence[Array], split: Split) -> None:
        self._parts, self._split = tuple(parts), split
        self._width = sum(part.size for part in parts)
        self._chunks: list[Array] = []
        self._length = 0

    def __len__(self) -> int:
        return self._length

    def take(self) -> None:
        """Append what the parts hold now."""
        place = self._length % CHUNK
        if place == 0:
            self._chunks.append(np.empty((CHUNK, self._width)))
        np.concatenate(self._parts, out=self._chunks[-1][place])
        self._length += 1

    def signals(self) -> dict[str, Array]:
        """Everything taken, by name, ticks along the first axis; (0, ...) if nothing was taken."""
        empty = self._split(np.empty((0, self._width)))
        signals = {
            name: np.empty((self._length, *like.shape[1:]), like.dtype)
            for name, like in empty.items()
        }
        # One chunk at a time: rows and signals are both in memory, and little else.
        for start, rows in self._rows():
            for name, values in self._split(rows).items():
                signals[name][start : start + len(rows)] = values
        return signals

    def _rows(self) -> Iterator[tuple[int, Array]]:
        for index, chunk in enumerate(self._chunks):
            start = index * CHUNK
            yield start, chunk[: self._length - start]
