"""When the gait formed: at the authors' first crossing, or at the start of lasting agreement."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from apnc.metrics.phases import phase_difference_authors, relative_phases, wrap
from apnc.metrics.smoothing import smooth
from apnc_core.types import Array

AUTHORS_THRESHOLD: Final = 2.8  # distance to the gait [rad], from the authors' evaluation code
STRICT_TOLERANCE: Final = 0.6  # deviation of a phase [rad]: a tenth of a cycle
STRICT_HOLD: Final = 1.0  # lasted at the end of the run [s]: about a stride at the lowest MI


def touch_moment(vertical_force: Array, weight: float) -> int | None:
    """Index of the first sample with at least two feet above four fifths of an even share.

    With four legs that is a fifth of the weight. None if there is none.

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
    error: Array = np.abs(wrap(phases - _checked(target, phases))).max(axis=1)
    return error


def convergence_time(
    time: Array, o1: Array, o2: Array, touch: int | None, target: ArrayLike
) -> float | None:
    """Time from the touch moment until every phase is at the gait for good [s], strict criterion.

    None if the gait did not form, or has not lasted for a second when the run ends. Pitfall: a late
    excursion beyond 0.6 rad moves the time to after it.
    """
    return None if touch is None else settling_time(time, phase_error(o1, o2, target), touch)


def settling_time(time: Array, error: Array, touch: int | None) -> float | None:
    """Time from the touch moment until an error (T,) stays within 0.6 rad [s].

    The same as ``convergence_time``, for who has the ``phase_error`` already.
    """
    if touch is None:
        return None
    # Written so that a NaN (undefined phase) counts as outside.
    outside = np.flatnonzero(~(error <= STRICT_TOLERANCE))
    start = max(int(outside[-1]) + 1 if len(outside) else 0, touch)
    if start >= len(time) or time[-1] - time[start] < STRICT_HOLD:
        return None
    return float(time[start] - time[touch])


def convergence_time_authors(
    time: Array, o1: Array, o2: Array, touch: int | None, target: ArrayLike
) -> float | None:
    """Time from the touch moment to the first sight of the gait [s], the authors' criterion.

    The distance of the unsigned phases to (pi, pi, 0), smoothed, falls below 2.8 rad. In phase it
    is 4.44 rad, with six and eight legs 5.44 and 6.28. Source: the authors' evaluation code.
    Pitfall: 2.8 rad is loose, and a first crossing need not last; compare ``convergence_time``.
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
