"""Which samples a page shows: all of a short run, and fewer of a long one."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from apnc_core.types import Array

SHOWN: Final = 15_000
"""Most samples of a run of which a page shows every one: 250 s at 60 Hz, 7 MB of page."""

LATE_S: Final = 10.0
"""Length of the end of a long run that is shown in full, and with which the page opens [s]."""


class Samples:
    """The samples that are shown.

    Args:
        time: sample times of the run [s], shape (T,), at least one.

    Attributes:
        block: number of samples of a long run that are shown by their least and their largest;
            0 for a short run.
        at: indices of the samples whose times are shown.
    """

    def __init__(self, time: Array) -> None:
        late = int(np.searchsorted(time, time[-1] - LATE_S)) if len(time) > SHOWN else 0
        self.block = 2 * math.ceil(late / SHOWN)
        self.early = late // self.block * self.block if late else 0
        step = self.block // 2 or 1
        self.at = np.concatenate([np.arange(0, self.early, step), np.arange(self.early, len(time))])

    @property
    def opens_at(self) -> int | None:
        """First sample of the part with which a long run opens; None for a short run."""
        return self.early if self.block else None

    def of(self, values: Array) -> Array:
        """What is shown of a signal of shape (T,): a value for each index in ``at``.

        A block has two values, its least and its largest. The least is first where the signal
        rises.
        """
        if not self.block:
            return values
        blocks = values[: self.early].reshape(-1, self.block)
        low, high = np.fmin.reduce(blocks, axis=1), np.fmax.reduce(blocks, axis=1)
        rises = (blocks[:, 0] <= blocks[:, -1])[:, None]
        pairs = np.where(rises, np.stack([low, high], axis=1), np.stack([high, low], axis=1))
        return np.concatenate([pairs.ravel(), values[self.early :]])
