"""Dual-rate learner: tunes the gain of the sensory feedback (Eq. 6-9)."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc_core.interface import Parameters
from apnc_core.types import Array

FORGOTTEN: Final = 1e-200
"""Gains below this count as zero; denormal numbers would slow the unloaded controller down."""


def error(F: Array, grf_expected: Array) -> Array:
    """Positive part of actual minus expected load, shape (n,) (Eq. 6)."""
    return np.maximum(F - grf_expected, 0.0)


def learn(K_f: Array, K_s: Array, e: Array, p: Parameters) -> tuple[Array, Array]:
    """Next states of the fast and the slow learner, shape (n,).

    Args:
        K_f, K_s: states at n, shape (n,).
        e: error, shape (n,).
        p: uses ``A_f``, ``B_f``, ``A_s``, ``B_s``.

    K(n+1) = A K(n) + B e(n) (Eq. 7, 8). Under a constant error, K tends to B e / (1 - A).
    """
    return _forget(p.A_f * K_f + p.B_f * e), _forget(p.A_s * K_s + p.B_s * e)


def gain(K_f: Array, K_s: Array) -> Array:
    """Feedback gain gamma = K_f + K_s, shape (n,) (Eq. 9)."""
    return K_f + K_s


def _forget(K: Array) -> Array:
    return np.where(K < FORGOTTEN, 0.0, K)
