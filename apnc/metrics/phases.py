"""Relative phases of the CPGs, signed (Eq. 12) and as the authors' code measures them."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from apnc.metrics.smoothing import WINDOW, smooth
from apnc_core.types import Array

Phasors = NDArray[np.complex128]

# Below this length the direction of a phasor is rounding noise.
_NO_DIRECTION: Final = 1e-6


def wrap(angle: ArrayLike) -> Array:
    """Angle [rad] wrapped into [-pi, pi)."""
    return (np.asarray(angle, dtype=np.float64) + np.pi) % (2 * np.pi) - np.pi


def wrap_for_display(angle: ArrayLike) -> Array:
    """Angle [rad] wrapped into [-pi/2, 3pi/2), which keeps both 0 and pi away from the cut."""
    return (np.asarray(angle, dtype=np.float64) + np.pi / 2) % (2 * np.pi) - np.pi / 2


def cpg_phase(o1: Array, o2: Array) -> Array:
    """Phase of a CPG [rad], in [-pi, pi], growing with time, 0 where o1 peaks; any shape.

    Equation 1-3 with w12 = 0.21 + MI > 0 and w21 = -w12: from (1, 0) the state moves to (0, -1),
    so the vector (o1, o2) turns clockwise and its phase is ``atan2(-o2, o1)``.
    Pitfall: ``atan2(o2, o1)`` runs backwards and flips the sign of every relative phase.
    """
    phase: Array = np.arctan2(-o2, o1)
    return phase


def relative_phases(o1: Array, o2: Array) -> Array:
    """Smoothed relative phases phi_12 .. phi_1n [rad], in [-pi, pi], shape (T, n - 1).

    Sign of Eq. 12: phi_lk = (t_p^l - t_p^k) / T * 2 pi with t_p the moment of a peak of o1, which
    is theta_k - theta_l: positive when leg k is ahead of leg 1. NaN where undefined.
    """
    return _angle(_relative_phasors(o1, o2))


def final_phases(o1: Array, o2: Array, sample_time: float, span: float = 1.0) -> Array:
    """Mean of the relative phases over the last ``span`` [s], in [-pi/2, 3pi/2) [rad], (n - 1,).

    NaN where undefined. The mean is that of the phasors: one of angles near the cut is meaningless.
    """
    phasors = _last_phasors(o1, o2, sample_time, span)
    if len(phasors) == 0:
        return np.full(phasors.shape[1], np.nan)
    return wrap_for_display(_angle(phasors.mean(axis=0)))


def coherence(o1: Array, o2: Array, sample_time: float, span: float) -> float | None:
    """How steady the relative phases are in the last ``span`` [s]: 1 steady, 0 on the move [1].

    Length of the mean of exp(i phi_1k), smoothed phases, of the leg that has the least; None
    without samples. A phase that drifts evenly through x rad has 2/x sin(x/2).
    """
    phases = _angle(_last_phasors(o1, o2, sample_time, span))
    if len(phases) == 0:
        return None
    return float(np.abs(np.nan_to_num(np.exp(1j * phases)).mean(axis=0)).min())


def phase_difference_authors(o1: Array, o2: Array) -> Array:
    """Angle between the vectors (o1, o2) of leg 1 and leg k [rad], in [0, pi], shape (T, n - 1).

    arccos of the normalised dot product, as in the authors' evaluation code. It has no sign.
    A CPG at the origin counts as in phase, so that a run never converges for lack of a signal.
    """
    dot = o1[:, :1] * o1[:, 1:] + o2[:, :1] * o2[:, 1:]
    length = np.hypot(o1, o2)
    scale = length[:, :1] * length[:, 1:]
    cosine = np.divide(dot, scale, out=np.ones_like(dot), where=scale > 0)
    result: Array = np.arccos(np.clip(cosine, -1.0, 1.0))
    return result


def _relative_phasors(o1: Array, o2: Array) -> Phasors:
    """Smoothed unit phasors exp(i phi_1k) for k = 2..n, shape (T, n - 1).

    Real and imaginary part are smoothed, so a phase that passes pi is no step. Where a CPG rests at
    the origin its phase is undefined and adds nothing. The limit cycle is no circle, so before
    smoothing the phase swings within a cycle.
    """
    z = o1 - 1j * o2
    product = z[:, 1:] * np.conj(z[:, :1])
    length = np.abs(product)
    unit = np.zeros(product.shape, np.complex128)  # by rows, whatever the order of the outputs
    np.divide(product, length, out=unit, where=length > 0)
    smoothed: Phasors = smooth(unit.view(np.float64)).view(np.complex128)
    return smoothed


def _last_phasors(o1: Array, o2: Array, sample_time: float, span: float) -> Phasors:
    """The relative phasors of the last ``span`` [s]; a window before it is all they depend on."""
    count = max(1, round(span / sample_time))
    needed = slice(-count - WINDOW, None)
    return _relative_phasors(o1[needed], o2[needed])[-count:]


def _angle(phasors: Phasors) -> Array:
    return np.where(np.abs(phasors) > _NO_DIRECTION, np.angle(phasors), np.nan)
