"""Stance, strides, duty factor and the coordination computed from them."""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

Bool = NDArray[np.bool_]

STANCE_SHARE: Final = 0.1
PEAK_QUANTILE: Final = 0.99
MIN_RUN: Final = 3
# A spread this small is rounding of identical strides, whose inverse would be a fantasy number.
_NO_SPREAD: Final = 1e-9


def stance(
    vertical_force: ArrayLike, min_run: int = MIN_RUN, quantile: float = PEAK_QUANTILE
) -> Bool:
    """Which feet stand, shape (T, n): force above a tenth of the largest force of leg 1.

    Args:
        vertical_force: vertical ground force on every foot [N], shape (T, n).
        min_run: shorter contacts and gaps [samples] are flicker and are removed.
        quantile: which quantile of the force of leg 1 counts as its largest; 1 is the maximum.

    Threshold as in the authors' evaluation code, except that flicker and rare peaks are ours.
    Pitfall: with the plain maximum a single impact of leg 1 (three times the weight for one sample
    is common on hard ground) raises the threshold for all legs and halves their duty factors.
    """
    force = np.asarray(vertical_force, dtype=np.float64)
    if force.size == 0:
        return np.zeros(force.shape, dtype=np.bool_)
    largest = max(float(np.quantile(force[:, 0], quantile)), 0.0)
    standing = force > STANCE_SHARE * largest
    columns = [_without_flicker(column, min_run) for column in standing.T]
    return np.stack(columns, axis=1)


def stride_starts(standing: ArrayLike) -> NDArray[np.intp]:
    """Indices of the touch-downs of one leg: samples in stance whose predecessor is in swing.

    Args:
        standing: stance of one leg, shape (T,).
    """
    s = np.asarray(standing, dtype=np.bool_)
    return np.flatnonzero(s[1:] & ~s[:-1]) + 1


def stride_duty(standing: ArrayLike) -> NDArray[np.float64]:
    """Share of stance in each complete stride of one leg, touch-down to touch-down, in (0, 1).

    Args:
        standing: stance of one leg, shape (T,).

    Returns:
        One value per complete stride, empty if there was none.
    """
    s = np.asarray(standing, dtype=np.bool_)
    starts = stride_starts(s)
    return np.array([s[a:b].mean() for a, b in pairwise(starts)], dtype=np.float64)


def duty_factors(standing: ArrayLike) -> list[float | None]:
    """Mean duty factor per leg over its complete strides; None for a leg without a stride.

    Args:
        standing: stance of every leg, shape (T, n).

    Pitfall: a leg that never leaves the ground has no duty factor here, rather than 1.
    """
    duties = [stride_duty(column) for column in np.asarray(standing, dtype=np.bool_).T]
    return [float(d.mean()) if len(d) else None for d in duties]


def stride_frequency(standing: ArrayLike, sample_time: float) -> float | None:
    """Mean stride frequency over all legs [Hz]; None without a complete stride.

    Args:
        standing: stance of every leg, shape (T, n).
        sample_time: time between samples [s].
    """
    starts = [stride_starts(column) for column in np.asarray(standing, dtype=np.bool_).T]
    strides = sum(max(len(s) - 1, 0) for s in starts)
    samples = sum(int(s[-1] - s[0]) for s in starts if len(s) > 1)
    return strides / (samples * sample_time) if samples and sample_time > 0 else None


def coordination(standing: ArrayLike) -> float | None:
    """Coordination of Fig. 7: 1 / largest standard deviation of the duty factor of any leg.

    Args:
        standing: stance of every leg, shape (T, n).

    Returns:
        None if a leg made fewer than two complete strides, or if the strides do not vary at all.
    """
    duties = [stride_duty(column) for column in np.asarray(standing, dtype=np.bool_).T]
    if not duties or min(len(d) for d in duties) < 2:
        return None
    spread = max(float(d.std()) for d in duties)
    return 1.0 / spread if spread > _NO_SPREAD else None


def _without_flicker(standing: Bool, min_run: int) -> Bool:
    # Gaps first: a contact cut in two by one lost sample must not be removed as two short ones.
    filled = _fill_short(standing, False, min_run)
    return _fill_short(filled, True, min_run)


def _fill_short(signal: Bool, value: bool, min_run: int) -> Bool:
    """Flip runs of ``value`` shorter than ``min_run``, but none cut off by an end."""
    result = signal.copy()
    edges = np.flatnonzero(np.diff(signal)) + 1
    for a, b in pairwise(edges):
        if signal[a] == value and b - a < min_run:
            result[a:b] = not value
    return result
