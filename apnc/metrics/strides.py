"""Stance and strides, and the measures of a stride: duty factor, coordination, lift and slip.

A stride of a leg is a cycle of its oscillator, from mid-swing to mid-swing. A foot that touches the
ground twice in a cycle still makes one stride, and its share of stance is that of both contacts.
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc.metrics.motion import MIN_SPEED
from apnc.metrics.phases import cpg_phase
from apnc_core.types import Array

Bool = NDArray[np.bool_]

MID_SWING: Final = 1.5 * np.pi
"""Phase of the CPG at which o2 and with it the command to the knee peaks [rad]."""
STANCE_SHARE: Final = 0.1
"""Share of the largest force above which a foot stands, from the authors' evaluation code [1]."""

PEAK_QUANTILE: Final = 0.99
"""Quantile that stands for the largest force [1], see docs/decisions/stance-and-strides.md."""

MIN_RUN: Final = 3
"""Shortest contact or gap that counts [samples], see docs/decisions/stance-and-strides.md."""

_NO_SPREAD: Final = 1e-9
"""Standard deviation of a share of stance that is the rounding of identical strides [1]."""


def stance(force: Array) -> Bool:
    """Which feet stand, shape (T, n).

    A foot stands while its force is above a tenth of the largest force of leg 1, as in the authors'
    evaluation code. Two things differ from it. Contacts and gaps shorter than three samples are
    removed. The largest force is the 99 % quantile, since an impact of leg 1 of three times the
    weight in one sample would hide the stance of all legs.

    Args:
        force: vertical force of the ground on every foot [N], shape (T, n).
    """
    if force.size == 0:
        return np.zeros(force.shape, dtype=np.bool_)
    largest = max(float(np.quantile(force[:, 0], PEAK_QUANTILE)), 0.0)
    standing = force > STANCE_SHARE * largest
    # gaps first, so that one lost sample does not make two short contacts, both removed, of one
    return _without_short(~_without_short(~standing))


def cycle_starts(o1: Array, o2: Array) -> list[Array]:
    """When the cycles of each oscillator begin [samples, with fractions], an array per leg.

    A cycle begins where the unwrapped phase first passes mid-swing, so k + 1 starts are k strides.
    An oscillator that rests, or moves to and fro without a full turn, has no cycle.
    """
    phases = np.unwrap(cpg_phase(o1, o2), axis=0)
    return [_passages(phase) for phase in np.maximum.accumulate(phases, axis=0).T]


def stride_frequency(starts: Sequence[Array], sample_time: float) -> float | None:
    """Stride frequency: one over the median duration of a cycle, mean over the legs [Hz].

    With the median, the quicker cycles in which the gait forms have no weight. Legs without a
    stride do not count; None if no leg has one.
    """
    # the median of the standard library is many times quicker for a few numbers
    periods = [sample_time * median(np.diff(s).tolist()) for s in starts if len(s) > 1]
    return float(np.mean([1.0 / period for period in periods])) if periods else None


def stride_length(speed: float | None, frequency: float | None) -> float | None:
    """Way of the trunk along its path in a stride [m].

    None if the robot stands or has no stride frequency.

    Args:
        speed: along the path [m/s].
        frequency: of the strides [Hz].
    """
    if speed is None or speed < MIN_SPEED or frequency is None:
        return None
    return speed / frequency


def duty_factors(standing: Bool, starts: Sequence[Array]) -> list[float | None]:
    """Duty factor of each leg: mean share of stance in a stride [1]; None without a stride.

    Pitfall: it is 1 for a leg whose oscillator runs but whose foot never leaves the ground.
    """
    return _means(_stance_shares(standing, starts))


def touch_downs_per_stride(standing: Bool, starts: Sequence[Array]) -> list[float | None]:
    """Mean number of touch-downs in a stride of each leg [1]; None without a stride.

    It is 1 for a clean step. It is larger if the foot touches the ground in swing, and smaller if
    the foot does not leave the ground in every stride.
    """
    down = np.zeros(standing.shape)
    down[1:] = standing[1:] & ~standing[:-1]
    return _means(_sums(down, starts))


def coordination(standing: Bool, starts: Sequence[Array], speed: float | None) -> float | None:
    """Coordination of Fig. 7: 1 / largest standard deviation of the share of stance of a leg [1].

    None if a leg made fewer than two strides, if the strides do not vary at all, or if the robot
    stands, since feet that never lift vary least.
    """
    shares = _stance_shares(standing, starts)
    if speed is None or speed < MIN_SPEED or min(len(s) for s in shares) < 2:
        return None
    spread = max(float(s.std()) for s in shares)
    return 1.0 / spread if spread > _NO_SPREAD else None


def foot_lifts(foot_position: Array, standing: Bool, starts: Sequence[Array]) -> list[float | None]:
    """Height of the foot in mid-swing above its mean height in stance [m]; None without a stride.

    Mean over the strides of each leg. The stance of a stride is compared with the mid-swings before
    and after it, so that a slope cancels. A stride without stance does not count. Pitfall:
    mid-swing is that of the oscillator. The servos follow a few hundredths of a second later, and
    the foot may be highest at another moment.

    Args:
        foot_position: centre of every foot in the world frame [m], shape (T, n, 3).
        standing, starts: see ``apnc.metrics``.
    """
    height = foot_position[..., 2]
    samples, heights = _sums(standing, starts), _sums(np.where(standing, height, 0.0), starts)
    lifts = []
    for z, begin, count, total in zip(height.T, starts, samples, heights, strict=True):
        high = np.interp(begin, np.arange(len(z)), z) if len(begin) else begin
        stood = count > 0
        lifts.append((high[:-1] + high[1:])[stood] / 2 - total[stood] / count[stood])
    return _means(lifts)


def slips(foot_position: Array, standing: Bool, starts: Sequence[Array]) -> list[float | None]:
    """Horizontal way of the foot in the stance of a stride [m]; None without a stride.

    Mean over the strides of each leg. Pitfall: the centre of a foot that rolls without slipping
    moves too, by its radius times the angle by which the leg turns. That is about 4 mm for Lilibot.

    Args:
        foot_position: centre of every foot in the world frame [m], shape (T, n, 3).
        standing, starts: see ``apnc.metrics``.
    """
    x, y = np.diff(foot_position[..., 0], axis=0), np.diff(foot_position[..., 1], axis=0)
    way = np.zeros(standing.shape)
    way[1:] = np.sqrt(x**2 + y**2) * (standing[1:] & standing[:-1])
    return _means(_sums(way, starts))


def _stance_shares(standing: Bool, starts: Sequence[Array]) -> list[Array]:
    """Share of stance in every stride [1], an array per leg."""
    lengths = (np.diff(_firsts(begin)) for begin in starts)
    return [time / length for time, length in zip(_sums(standing, starts), lengths, strict=True)]


def _sums(values: Array | Bool, starts: Sequence[Array]) -> list[Array]:
    """Sum of the values (T, n) over every stride, an array per leg."""
    columns = zip(values.T, map(_firsts, starts), strict=True)
    # reduceat needs a sample in each stride: an unwrapped phase moves by at most half a turn in a
    # tick. What it sums after the last start is not a whole stride.
    return [np.add.reduceat(column, at, dtype=np.float64)[:-1] for column, at in columns]


def _firsts(begin: Array) -> NDArray[np.intp]:
    """First samples of the strides of a leg."""
    return np.ceil(begin).astype(np.intp)


def _means(figures: Sequence[Array]) -> list[float | None]:
    return [float(values.mean()) if len(values) else None for values in figures]


def _passages(phase: Array) -> Array:
    """When a phase that never falls passes mid-swing [samples, with fractions]."""
    if len(phase) == 0:
        return np.empty(0)
    turns = (phase[[0, -1]] - MID_SWING) / (2 * np.pi)
    passed = MID_SWING + 2 * np.pi * np.arange(np.ceil(turns[0]), np.floor(turns[1]) + 1)
    return np.interp(passed, phase, np.arange(len(phase)))


def _without_short(signals: Bool) -> Bool:
    """Set runs of True below three samples to False in the signals (T, n).

    A run at the first or the last sample may have been longer and stays.
    """
    spare = MIN_RUN - 1
    longer = np.concatenate([signals[:1]] * spare + [signals] + [signals[-1:]] * spare)
    begins = np.logical_and.reduce(_shifted(longer))  # of MIN_RUN samples that are all True
    inside: Bool = np.logical_or.reduce(_shifted(begins))
    return inside


def _shifted(signals: Bool) -> list[Bool]:
    """Every sample but the last ones, and the samples behind it, MIN_RUN in all."""
    length = len(signals) - MIN_RUN + 1
    return [signals[k : k + length] for k in range(MIN_RUN)]
