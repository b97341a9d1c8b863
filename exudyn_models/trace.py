"""Rows of numbers taken once per tick: cheap while the robot walks, split by name afterwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from exudyn_models.robot.model import Array

Split = Callable[[Array], Mapping[str, Array]]


class Trace:
    """A table with one row per tick.

    Args:
        parts: arrays whose entries, one after the other, are a row; read anew at every tick.
        split: makes channels of rows of shape (ticks, width).
    """

    def __init__(self, parts: Sequence[Array], split: Split) -> None:
        self._parts, self._split = tuple(parts), split
        self._rows = np.empty((4096, sum(part.size for part in parts)))
        self._used = 0

    def __len__(self) -> int:
        return self._used

    def take(self) -> None:
        """Append what the parts hold now."""
        if self._used == len(self._rows):
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)])
        np.concatenate(self._parts, out=self._rows[self._used])
        self._used += 1

    def channels(self) -> dict[str, Array]:
        """Everything taken, by name, ticks along the first axis."""
        return dict(self._split(self._rows[: self._used]))
