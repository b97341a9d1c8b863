"""Relative phases of the CPGs: signed as in Eq. 12, and unsigned as in the authors' code."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from apnc.metrics.smoothing import WINDOW, smooth
from apnc_core.types import Array

Phasors = NDArray[np.complex128]

_NO_DIRECTION: Final = 1e-6
"""Length below which the direction of a phasor is rounding noise [1]."""


def wrap(angle: ArrayLike) -> Array:
    """Angle wrapped into [-pi, pi) [rad]."""
    return (np.asarray(angle, dtype=np.float64) + np.pi) % (2 * np.pi) - np.pi


def wrap_for_display(angle: ArrayLike) -> Array:
    """Angle wrapped into [-pi/2, 3pi/2) [rad], so that neither 0 nor pi lies at the cut."""
    return (np.asarray(angle, dtype=np.float64) + np.pi / 2) % (2 * np.pi) - np.pi / 2


def cpg_phase(o1: Array, o2: Array) -> Array:
    """Phase of a CPG in [-pi, pi] [rad], of any shape. It grows with time and is 0 where o1 peaks.

    With w12 = 0.21 + MI > 0 and w21 = -w12 in Eq. 1-3, the state moves from (1, 0) to (0, -1). The
    vector (o1, o2) turns clockwise, so its phase is ``atan2(-o2, o1)``. Pitfall: ``atan2(o2, o1)``
    falls with time and gives every relative phase the wrong sign.
    """
    phase: Array = np.arctan2(-o2, o1)
    return phase


def relative_phases(o1: Array, o2: Array) -> Array:
    """Smoothed relative phases phi_12 .. phi_1n in [-pi, pi] [rad], shape (T, n - 1).

    The sign is that of Eq. 12: phi_lk = 2 pi (t_p^l - t_p^k) / T, where t_p is the time of a peak
    of o1. So phi_1k is positive where leg k is ahead of leg 1. NaN where undefined.
    """
    return _angle(_relative_phasors(o1, o2))


def final_phases(o1: Array, o2: Array, sample_time: float, span: float = 1.0) -> Array:
    """Mean relative phases at the end of the run in [-pi/2, 3pi/2) [rad], shape (n - 1,).

    NaN where undefined. It is the mean of the phasors, since a mean of angles on both sides of the
    cut has no meaning.

    Args:
        o1, o2, sample_time: see ``apnc.metrics``.
        span: length of the end [s].
    """
    phasors = _last_phasors(o1, o2, sample_time, span)
    if len(phasors) == 0:
        return np.full(phasors.shape[1], np.nan)
    return wrap_for_display(_angle(phasors.mean(axis=0)))


def coherence(o1: Array, o2: Array, sample_time: float, span: float) -> float | None:
    """Steadiness of the relative phases at the end of the run [1]: 1 for constant phases.

    It is the length of the mean of exp(i phi_1k), of smoothed phases, smallest over the legs. A
    phase that drifts evenly by x rad has 2/x sin(x/2). None without samples.

    Args:
        o1, o2, sample_time: see ``apnc.metrics``.
        span: length of the end [s].
    """
    phases = _angle(_last_phasors(o1, o2, sample_time, span))
    if len(phases) == 0:
        return None
    return float(np.abs(np.nan_to_num(np.exp(1j * phases)).mean(axis=0)).min())


def phase_difference_authors(o1: Array, o2: Array) -> Array:
    """Angle between the vectors (o1, o2) of leg 1 and leg k in [0, pi] [rad], shape (T, n - 1).

    It is the arccos of the normalised dot product, as in the authors' evaluation code, and has no
    sign. A CPG at the origin counts as in phase, so that no run converges for lack of a signal.
    """
    dot = o1[:, :1] * o1[:, 1:] + o2[:, :1] * o2[:, 1:]
    length = np.hypot(o1, o2)
    scale = length[:, :1] * length[:, 1:]
    cosine = np.divide(dot, scale, out=np.ones_like(dot), where=scale > 0)
    result: Array = np.arccos(np.clip(cosine, -1.0, 1.0))
    return result


def _relative_phasors(o1: Array, o2: Array) -> Phasors:
    """Smoothed unit phasors exp(i phi_1k) for k = 2..n, shape (T, n - 1).

    Real and imaginary part are smoothed, so that a phase which passes pi makes no step. A CPG at
    the origin has no phase and adds nothing. Since the limit cycle is not a circle, the phase
    swings within a cycle before it is smoothed.
    """
    z = o1 - 1j * o2
    product = z[:, 1:] * np.conj(z[:, :1])
    length = np.abs(product)
    unit = np.zeros(product.shape, np.complex128)  # by rows, whatever the order of the outputs
    np.divide(product, length, out=unit, where=length > 0)
    smoothed: Phasors = smooth(unit.view(np.float64)).view(np.complex128)
    return smoothed


def _last_phasors(o1: Array, o2: Array, sample_time: float, span: float) -> Phasors:
    """The relative phasors of the last ``span`` [s], of these samples and a window before them."""
    count = max(1, round(span / sample_time))
    needed = slice(-count - WINDOW, None)
    return _relative_phasors(o1[needed], o2[needed])[-count:]


def _angle(phasors: Phasors) -> Array:
    return np.where(np.abs(phasors) > _NO_DIRECTION, np.angle(phasors), np.nan)
