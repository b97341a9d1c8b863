"""Relative phases of the CPGs, signed (Eq. 12) and as the authors' code measures them."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from apnc.metrics.smoothing import smooth

Array = NDArray[np.float64]
Phasor = NDArray[np.complex128]

# Below this length the direction of a phasor is rounding noise.
_NO_DIRECTION: Final = 1e-6


def wrap(angle: ArrayLike) -> Array:
    """Angle [rad] wrapped into [-pi, pi)."""
    return (np.asarray(angle, dtype=np.float64) + np.pi) % (2 * np.pi) - np.pi


def wrap_for_display(angle: ArrayLike) -> Array:
    """Angle [rad] wrapped into [-pi/2, 3pi/2), which keeps both 0 and pi away from the cut."""
    return (np.asarray(angle, dtype=np.float64) + np.pi / 2) % (2 * np.pi) - np.pi / 2


def cpg_phase(o1: ArrayLike, o2: ArrayLike) -> Array:
    """Phase of a CPG [rad], in [-pi, pi], growing with time, 0 where o1 peaks.

    Args:
        o1: output of neuron N1, any shape.
        o2: output of neuron N2, same shape.

    Equation 1-3 with w12 = 0.21 + MI > 0 and w21 = -w12: from (1, 0) the state moves to (0, -1),
    so the vector (o1, o2) turns clockwise and its phase is ``atan2(-o2, o1)``.
    Pitfall: ``atan2(o2, o1)`` runs backwards and flips the sign of every relative phase.
    """
    return np.arctan2(-np.asarray(o2, dtype=np.float64), np.asarray(o1, dtype=np.float64))


def relative_phasors(o1: ArrayLike, o2: ArrayLike) -> Phasor:
    """Smoothed unit phasors exp(i phi_1k) for k = 2..n, shape (T, n - 1).

    Args:
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).

    Real and imaginary part are smoothed (Savitzky-Golay, 91 samples, order 2), so a phase that
    passes pi is no step. Where a CPG rests at the origin its phase is undefined and adds nothing.
    Pitfall: the limit cycle is no circle, so before smoothing the phase swings within a cycle.
    """
    z = np.asarray(o1, dtype=np.float64) - 1j * np.asarray(o2, dtype=np.float64)
    product = z[:, 1:] * np.conj(z[:, :1])
    length = np.abs(product)
    unit = np.divide(product, length, out=np.zeros_like(product), where=length > 0)
    return smooth(unit.real) + 1j * smooth(unit.imag)


def relative_phases(o1: ArrayLike, o2: ArrayLike) -> Array:
    """Smoothed relative phases phi_12 .. phi_1n [rad], in [-pi, pi], shape (T, n - 1).

    Args:
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).

    Sign of Eq. 12: phi_lk = (t_p^l - t_p^k) / T * 2 pi with t_p the moment of a peak of o1, which
    is theta_k - theta_l: positive when leg k is ahead of leg 1. NaN where undefined.
    """
    return _angle(relative_phasors(o1, o2))


def final_phases(o1: ArrayLike, o2: ArrayLike, sample_time: float, span: float = 1.0) -> Array:
    """Mean of the smoothed relative phases over the last second [rad], in [-pi/2, 3pi/2).

    Args:
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).
        sample_time: time between samples [s].
        span: length of the averaged end of the run [s].

    Returns:
        Shape (n - 1,), NaN where undefined.

    Pitfall: the mean is taken over phasors; a mean of wrapped angles near the cut is meaningless.
    """
    phasors = relative_phasors(o1, o2)
    if len(phasors) == 0:
        return np.full(phasors.shape[1], np.nan)
    samples = max(1, round(span / sample_time)) if sample_time > 0 else len(phasors)
    return wrap_for_display(_angle(phasors[-samples:].mean(axis=0)))


def phase_difference_authors(o1: ArrayLike, o2: ArrayLike) -> Array:
    """Angle between the vectors (o1, o2) of leg 1 and leg k [rad], in [0, pi], shape (T, n - 1).

    Args:
        o1: output of neuron N1 of every CPG, shape (T, n).
        o2: output of neuron N2 of every CPG, shape (T, n).

    arccos of the normalised dot product, as in the authors' evaluation code. It has no sign.
    A CPG at the origin counts as in phase, so that a run never converges for lack of a signal.
    """
    a = np.asarray(o1, dtype=np.float64)
    b = np.asarray(o2, dtype=np.float64)
    dot = a[:, :1] * a[:, 1:] + b[:, :1] * b[:, 1:]
    length = np.hypot(a, b)
    scale = length[:, :1] * length[:, 1:]
    cosine = np.divide(dot, scale, out=np.ones_like(dot), where=scale > 0)
    result: Array = np.arccos(np.clip(cosine, -1.0, 1.0))
    return result


def phase_from_peaks(time: ArrayLike, o1_l: ArrayLike, o1_k: ArrayLike) -> float | None:
    """Relative phase phi_lk [rad], in [-pi, pi), from the last peaks of o1, Eq. 12 to the letter.

    Args:
        time: sample times [s], shape (T,).
        o1_l: output of neuron N1 of leg l, shape (T,).
        o1_k: output of neuron N1 of leg k, shape (T,).

    Returns:
        None with fewer than two peaks of leg l or none of leg k.

    Pitfall: peaks fall on samples, so one tick of 1/60 s at 1.4 Hz is 0.15 rad.
    """
    t = np.asarray(time, dtype=np.float64)
    peaks_l, peaks_k = t[_peaks(o1_l)], t[_peaks(o1_k)]
    if len(peaks_l) < 2 or len(peaks_k) < 1:
        return None
    period = peaks_l[-1] - peaks_l[-2]
    return float(wrap(2 * np.pi * (peaks_l[-1] - peaks_k[-1]) / period))


def _peaks(signal: ArrayLike) -> NDArray[np.intp]:
    s = np.asarray(signal, dtype=np.float64)
    inner = (s[1:-1] > s[:-2]) & (s[1:-1] >= s[2:]) & (s[1:-1] > 0)
    return np.flatnonzero(inner) + 1


def _angle(phasors: Phasor) -> Array:
    return np.where(np.abs(phasors) > _NO_DIRECTION, np.angle(phasors), np.nan)
