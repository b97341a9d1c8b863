"""When did the gait form: the authors' first crossing, and a criterion that cannot be grazed."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from apnc.metrics.phases import phase_difference_authors, relative_phases, wrap
from apnc.metrics.smoothing import smooth

Array = NDArray[np.float64]

_TARGETS: Final[dict[int, tuple[float, ...]]] = {
    4: (np.pi, np.pi, 0.0),
    6: (np.pi, 0.0, np.pi, 0.0, np.pi),
}
AUTHORS_THRESHOLD: Final = 2.8
STRICT_TOLERANCE: Final = 0.6
STRICT_HOLD: Final = 1.0


def default_target(n_legs: int) -> tuple[float, ...] | None:
    """Relative phases [rad] of the gait expected of n legs, None if there is no usual one.

    Four legs (RF, RH, LF, LH): the trot (pi, pi, 0) of the paper. Six legs (RF, RM, RH, LF, LM,
    LH): the tripod (pi, 0, pi, 0, pi).
    """
    return _TARGETS.get(n_legs)


def touch_moment(vertical_force: ArrayLike, weight: float) -> int | None:
    """Index of the first sample with at least two feet above a fifth of the weight, else None.

    Args:
        vertical_force: vertical ground force on every foot [N], shape (T, n).
        weight: weight of the robot [N].
    """
    loaded = np.asarray(vertical_force, dtype=np.float64) > weight / 5
    both = np.flatnonzero(loaded.sum(axis=1) >= 2)
    return int(both[0]) if len(both) else None


def phase_error(o1: ArrayLike, o2: ArrayLike, target: ArrayLike) -> Array:
    """Largest deviation of the smoothed relative phases from a gait [rad], shape (T,).

    Args:
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).
        target: relative phases phi_12 .. phi_1n of the gait [rad], shape (n - 1,).

    Raises:
        ValueError: the target does not have n - 1 entries.
    """
    phases = relative_phases(o1, o2)
    wanted = _checked_target(target, phases.shape[1])
    error: Array = np.abs(wrap(phases - wanted)).max(axis=1)
    return error


def convergence_time(
    time: ArrayLike,
    o1: ArrayLike,
    o2: ArrayLike,
    touch: int | None,
    target: ArrayLike,
    tolerance: float = STRICT_TOLERANCE,
    hold: float = STRICT_HOLD,
) -> float | None:
    """Time from the touch moment until every phase is at the gait for good [s], strict criterion.

    Args:
        time: sample times [s], shape (T,).
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).
        touch: index of the touch moment, None if the robot never stood.
        target: relative phases of the gait [rad], shape (n - 1,).
        tolerance: largest deviation allowed of any phase [rad].
        hold: the phases must have been there at least this long when the run ends [s].

    Returns:
        None if the gait did not form or did not last to the end of the run.

    Pitfall: one late excursion moves the time to after it; that is the point of the criterion.
    """
    t = np.asarray(time, dtype=np.float64)
    if touch is None or len(t) == 0:
        return None
    # Written so that a NaN (undefined phase) counts as outside.
    outside = np.flatnonzero(~(phase_error(o1, o2, target) <= tolerance))
    first = int(outside[-1]) + 1 if len(outside) else 0
    start = max(first, touch)
    if start >= len(t) or t[-1] - t[start] < hold:
        return None
    return float(t[start] - t[touch])


def convergence_time_authors(
    time: ArrayLike,
    o1: ArrayLike,
    o2: ArrayLike,
    touch: int | None,
    target: ArrayLike,
    threshold: float = AUTHORS_THRESHOLD,
) -> float | None:
    """Time from the touch moment to the first sight of the gait [s], the authors' criterion.

    Args:
        time: sample times [s], shape (T,).
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).
        touch: index of the touch moment, None if the robot never stood.
        target: unsigned relative phases of the gait [rad], in [0, pi], shape (n - 1,).
        threshold: Euclidean distance to the gait below which it counts as reached [rad].

    The distance of the unsigned phases to (pi, pi, 0) is smoothed (Savitzky-Golay, 91 samples,
    order 2); in phase it is 4.44 rad. Source: the authors' evaluation code.
    Pitfall: 2.8 rad is loose and a first crossing need not last; compare ``convergence_time``.
    """
    t = np.asarray(time, dtype=np.float64)
    if touch is None or len(t) == 0:
        return None
    phases = phase_difference_authors(o1, o2)
    wanted = _checked_target(target, phases.shape[1])
    distance = smooth(np.linalg.norm(phases - wanted, axis=1))
    below = np.flatnonzero(distance[touch:] < threshold)
    return float(t[touch + int(below[0])] - t[touch]) if len(below) else None


def _checked_target(target: ArrayLike, n_phases: int) -> Array:
    wanted = np.asarray(target, dtype=np.float64)
    if wanted.shape != (n_phases,):
        raise ValueError(f"target needs {n_phases} relative phases, got shape {wanted.shape}")
    return wanted
