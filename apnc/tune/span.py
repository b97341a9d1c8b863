"""The MI range of a tuned robot: where its gait was found, of the range that was aimed at."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from apnc.tune.aims import AIM_LIFT, AIM_SLIP
from apnc.tune.measured import Measured

LEAST: Final = 0.5
"""Least part of the range that is aimed at, in even steps of log MI [1]: less would be no range."""

DIGITS: Final = 3
"""Significant digits of an end of the range."""


def found_range(mi: tuple[float, float], runs: Sequence[Measured]) -> tuple[float, float]:
    """The longest part of an MI range over which a robot walks as it should.

    It is that in which all its walks, with and without couplings, are good and its feet lift and
    hold as aimed at; if that is too short, that in which all are good; then that in which it walks
    well with couplings; else the whole range.

    Args:
        mi: the range, lowest and highest MI.
        runs: of both kinds at even steps of log MI, see ``runs.of_range``.
    """
    steps = sorted({run.share for run in runs})
    at = [[run for run in runs if run.share == share] for share in steps]
    low, high = mi
    for fits in (_as_aimed, _good, _with_couplings):
        begin, end = _longest([all(map(fits, each)) for each in at])
        if end - begin >= LEAST * (len(steps) - 1):
            shares = steps[begin], steps[end]
            first, last = (float(f"{low * (high / low) ** s:.{DIGITS}g}") for s in shares)
            return max(first, low), min(last, high)
    return mi


def _with_couplings(run: Measured) -> bool:
    return run.good or run.kind == "apc"


def _good(run: Measured) -> bool:
    return run.good


def _as_aimed(run: Measured) -> bool:
    return run.good and (run.kind == "apc" or (run.lift >= AIM_LIFT and run.slip <= AIM_SLIP))


def _longest(good: Sequence[bool]) -> tuple[int, int]:
    """First and last index of the longest part that is good throughout; (0, -1) without one."""
    best, begin = (0, -1), 0
    for index, each in enumerate([*good, False]):
        if each:
            continue
        if index - begin > best[1] - best[0] + 1:
            best = (begin, index - 1)
        begin = index + 1
    return best
