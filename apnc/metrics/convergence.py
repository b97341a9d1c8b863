"""When the gait formed, by the authors' criterion and by a strict one."""

from __future__ import annotations

from functools import reduce
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from apnc.metrics.phases import phase_difference_authors, relative_phases, wrap
from apnc.metrics.smoothing import smooth
from apnc_core.types import Array

AUTHORS_THRESHOLD: Final = 2.8
"""Distance to the gait below which it has formed, from the authors' evaluation code [rad]."""

STRICT_TOLERANCE: Final = 0.6
"""Largest deviation of a phase from the gait [rad], about a tenth of a cycle."""

STRICT_HOLD: Final = 1.0
"""Least time for which the gait must have held at the end [s], about a stride at the lowest MI."""


def touch_moment(vertical_force: Array, weight: float) -> int | None:
    """Index of the first sample at which at least two feet are loaded; None if there is none.

    A foot is loaded above four fifths of an even share of the weight. With four legs that is a
    fifth of the weight.

    Args:
        vertical_force: of the ground on every foot [N], shape (T, n).
        weight: of the robot [N].
    """
    share = weight / (1.25 * vertical_force.shape[1])
    both = np.flatnonzero((vertical_force > share).sum(axis=1) >= 2)
    return int(both[0]) if len(both) else None


def phase_error(o1: Array, o2: Array, target: ArrayLike) -> Array:
    """Largest deviation of the smoothed relative phases from a gait [rad], shape (T,).

    Raises:
        ValueError: the target does not have n - 1 entries.
    """
    phases = relative_phases(o1, o2)
    errors = np.abs(wrap(phases - _checked(target, phases)))
    # by column, which takes a fifth of the time of a maximum over short rows
    return reduce(np.maximum, errors.T)


def convergence_time(
    time: Array, o1: Array, o2: Array, touch: int | None, target: ArrayLike
) -> float | None:
    """Time from the touch moment until every phase stays within 0.6 rad of the gait [s].

    This is the strict criterion. None if the gait did not form, or has held for less than a second
    when the run ends. Pitfall: if a phase leaves the tolerance late in the run, the time is that of
    its return.
    """
    return None if touch is None else settling_time(time, phase_error(o1, o2, target), touch)


def settling_time(time: Array, error: Array, touch: int | None) -> float | None:
    """Time from the touch moment until the phase error stays within 0.6 rad [s].

    The same as :func:`convergence_time`, of the result of :func:`phase_error`, shape (T,).
    """
    if touch is None:
        return None
    # written this way, NaN (an undefined phase) is outside
    outside = np.flatnonzero(~(error <= STRICT_TOLERANCE))
    start = max(int(outside[-1]) + 1 if len(outside) else 0, touch)
    if start >= len(time) or time[-1] - time[start] < STRICT_HOLD:
        return None
    return float(time[start] - time[touch])


def convergence_time_authors(
    time: Array, o1: Array, o2: Array, touch: int | None, target: ArrayLike
) -> float | None:
    """Time from the touch moment until the gait is near for the first time [s].

    This is the authors' criterion: the smoothed distance of the unsigned phases to the gait falls
    below 2.8 rad. The distance of legs that are all in phase is 4.44 rad with four legs, 5.44 with
    six and 6.28 with eight. Source: the authors' evaluation code. Pitfall: 2.8 rad is loose, and
    the gait may be lost again, see :func:`convergence_time`.
    """
    if touch is None:
        return None
    phases = phase_difference_authors(o1, o2)
    distance = smooth(np.linalg.norm(phases - _checked(target, phases), axis=1))
    below = np.flatnonzero(distance[touch:] < AUTHORS_THRESHOLD)
    return float(time[touch + below[0]] - time[touch]) if len(below) else None


def _checked(target: ArrayLike, phases: Array) -> Array:
    wanted = np.asarray(target, dtype=np.float64)
    if wanted.shape != phases.shape[1:]:
        raise ValueError(f"target {wanted.tolist()} does not have {phases.shape[1]} phases")
    return wanted
