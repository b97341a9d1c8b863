"""Curves through measured points."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np


class Between(NamedTuple):
    """Where an error lies between those of a coarse and a fine step.

    Args:
        coarse, fine: steps per tick.
        share: of the way from coarse to fine, in logarithms.
    """

    coarse: int
    fine: int
    share: float

    @property
    def steps(self) -> float:
        """Steps per tick at the error."""
        return self.cost(self.coarse, self.fine)

    def cost(self, coarse: float, fine: float) -> float:
        """Cost at the error, from those of the two steps; it goes with a power of the step."""
        return float(coarse * (fine / coarse) ** self.share)


def between(found: dict[int, float], wanted: float) -> Between:
    """The steps between whose errors one lies; the coarsest alone if that is good enough.

    Args:
        found: error by steps per tick, from the coarsest on.
        wanted: the error.

    Raises:
        ValueError: the finest is not good enough.
    """
    coarsest = next(iter(found))
    if found[coarsest] <= wanted:
        return Between(coarsest, coarsest, 0.0)
    for coarse, fine in pairwise(found):
        if found[fine] <= wanted:
            share = np.log(wanted / found[coarse]) / np.log(found[fine] / found[coarse])
            return Between(coarse, fine, float(share))
    raise ValueError(f"an error of {wanted:.3g} is beyond those measured: {found}")


def line(places: Sequence[float], values: Sequence[float]) -> tuple[float, float, float]:
    """Straight line through values, by least squares of the relative errors.

    Args:
        places: where they are.
        values: at least two.

    Returns:
        The line at 0, its slope, and the largest distance of a value from it [%].
    """
    x, y = np.array(places, float), np.array(values, float)
    terms = np.stack([np.ones_like(x), x], axis=1) / y[:, np.newaxis]
    (begin, slope), *_ = np.linalg.lstsq(terms, np.ones_like(x), rcond=None)
    off = np.abs(begin + slope * x - y) / y
    return float(begin), float(slope), 100.0 * float(off.max())
