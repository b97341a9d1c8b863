"""Records a sample at every tick at low cost, and splits the samples into signals afterwards."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from apnc_core.types import Array

Split = Callable[[Array], Mapping[str, Array]]

CHUNK: Final = 1024
"""Number of samples allocated at a time."""


class Trace:
    """Samples, one per tick; their number grows.

    Args:
        parts: arrays that together make a sample; they are read anew at every tick.
        split: splits samples, shape (ticks, width), into signals.
    """

    def __init__(self, parts: Sequence[Array], split: Split) -> None:
        self._parts, self._split = tuple(parts), split
        self._width = sum(part.size for part in parts)
        self._chunks: list[Array] = []
        self._length = 0

    def __len__(self) -> int:
        return self._length

    def take(self) -> None:
        """Append a sample: the values that the parts hold now."""
        entry = self._length % CHUNK
        if entry == 0:
            self._chunks.append(np.empty((CHUNK, self._width)))
        np.concatenate(self._parts, out=self._chunks[-1][entry])
        self._length += 1

    def signals(self) -> dict[str, Array]:
        """All samples by signal, ticks along the first axis; shape (0, ...) if there are none."""
        empty = self._split(np.empty((0, self._width)))
        signals = {
            name: np.empty((self._length, *like.shape[1:]), like.dtype)
            for name, like in empty.items()
        }
        # One chunk at a time, so that little else than samples and signals is in memory.
        for start, samples in self._samples():
            for name, values in self._split(samples).items():
                signals[name][start : start + len(samples)] = values
        return signals

    def _samples(self) -> Iterator[tuple[int, Array]]:
        for index, chunk in enumerate(self._chunks):
            start = index * CHUNK
            yield start, chunk[: self._length - start]
