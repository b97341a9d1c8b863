"""The MI range of a tuned robot: where its gait was found, of the range that was aimed at."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median
from typing import Final

from apnc.tune.aims import AIM_ALONE, AIM_LIFT, AIM_SLIP
from apnc.tune.design import MI_AIMED
from apnc.tune.measured import Measured

LEAST: Final = 0.5
"""Least range, as a share of ``MI_AIMED`` on a logarithmic scale [1]: less would be no range."""

DIGITS: Final = 3
"""Significant digits of an end of the range."""


def found_range(mi: tuple[float, float], runs: Sequence[Measured]) -> tuple[float, float]:
    """The longest part of an MI range over which a robot walks as it should.

    It is that in which the robot reaches its aims at every MI; if that is too short, that in which
    its gait forms and walks as often as is aimed at, with and without couplings; then that in which
    it does so with couplings; else the whole range. At its ends, beyond which the robot does worse,
    all walks are good if enough is left: a count of so few is uncertain there.

    Args:
        mi: the range, lowest and highest MI.
        runs: of both kinds at even steps of log MI, several of each, see ``runs.of_range``.
    """
    steps = sorted({run.share for run in runs})
    at = [[run for run in runs if run.share == share] for share in steps]
    low, high = mi
    least = min(1.0, LEAST * math.log(MI_AIMED[1] / MI_AIMED[0]) / math.log(high / low))
    for fits in (_as_aimed, _good, _with_couplings):
        begin, end = _longest([fits(each) for each in at])
        if end - begin >= least * (len(steps) - 1):
            if fits is not _with_couplings:
                begin, end = _surer(begin, end, at, least * (len(steps) - 1))
            shares = steps[begin], steps[end]
            first, last = (float(f"{low * (high / low) ** s:.{DIGITS}g}") for s in shares)
            return max(first, low), min(last, high)
    return mi


def _with_couplings(runs: Sequence[Measured]) -> bool:
    return all(run.good for run in runs if run.kind == "walk")


def _good(runs: Sequence[Measured]) -> bool:
    alone = [run.good for run in runs if run.kind == "apc"]
    return _with_couplings(runs) and sum(alone) >= AIM_ALONE * len(alone)


def _as_aimed(runs: Sequence[Measured]) -> bool:
    walks = [run for run in runs if run.kind == "walk"]
    lift, slip = (median(getattr(run, name) for run in walks) for name in ("lift", "slip"))
    return _good(runs) and lift >= AIM_LIFT and slip <= AIM_SLIP


def _surer(begin: int, end: int, at: Sequence[Sequence[Measured]], least: float) -> tuple[int, int]:
    """The part without ends at which a walk fails, as far as it stays long enough."""
    while end - begin - 1 >= least:
        if not all(run.good for run in at[begin]):
            begin += 1
        elif not all(run.good for run in at[end]):
            end -= 1
        else:
            break
    return begin, end


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
