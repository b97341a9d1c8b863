"""Which samples a page shows: all of a short run, fewer of a long one."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from apnc_core.types import Array

SHOWN: Final = 15_000
"""Samples per line of which a page shows every one; 250 s at 60 Hz, 16 MB of page."""

LATE_S: Final = 10.0
"""Last part of a long run [s]: shown in full, and what the page opens on."""


class Samples:
    """The samples that are shown.

    Args:
        time: sample times of the run [s], shape (T,), at least one.

    Attributes:
        block: so many samples of a long run are shown by the least and the largest of them.
        at: indices of the samples whose times stand for what is shown.
    """

    def __init__(self, time: Array) -> None:
        late = int(np.searchsorted(time, time[-1] - LATE_S)) if len(time) > SHOWN else 0
        self.block = 2 * math.ceil(late / SHOWN)
        self.early = late // self.block * self.block if late else 0
        step = self.block // 2 or 1
        self.at = np.concatenate([np.arange(0, self.early, step), np.arange(self.early, len(time))])

    @property
    def opens_at(self) -> int | None:
        """First sample of what a long run opens on; None for a short one."""
        return self.early if self.block else None

    def of(self, values: Array) -> Array:
        """What is shown of a signal of shape (T,), one value per index in ``at``.

        Every second value of a block is the least, the others are the largest; the least comes
        first where the signal rises.
        """
        if not self.block:
            return values
        blocks = values[: self.early].reshape(-1, self.block)
        low, high = np.fmin.reduce(blocks, axis=1), np.fmax.reduce(blocks, axis=1)
        rises = (blocks[:, 0] <= blocks[:, -1])[:, None]
        pairs = np.where(rises, np.stack([low, high], axis=1), np.stack([high, low], axis=1))
        return np.concatenate([pairs.ravel(), values[self.early :]])
