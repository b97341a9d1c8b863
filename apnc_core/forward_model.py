"""Forward model: the load that the leg's own motion lets it expect (Eq. 10-11)."""

from __future__ import annotations

import numpy as np

from apnc_core.interface import Array, Parameters


def stance_expected(theta_hip: Array, theta_hip_before: Array) -> Array:
    """G(n), shape (n,): 1 while the hip command does not rise, else 0 (Eq. 11).

    Args:
        theta_hip, theta_hip_before: hip commands at n and n - 1 [rad], shape (n,).

    Pitfall: the text speaks of the knee, the equation takes theta_1, the hip.
    """
    return np.where(theta_hip <= theta_hip_before, 1.0, 0.0)


def expect(grf_expected: Array, G: Array, p: Parameters) -> Array:
    """Expected load over half the weight at n + 1, shape (n,).

    Args:
        grf_expected: F^e(n), shape (n,).
        G: expected stance, shape (n,).
        p: uses ``alpha``, ``rho``.

    F^e(n+1) = alpha (rho G(n) + (1 - rho) F^e(n)) (Eq. 10). In lasting stance it tends to
    alpha rho / (1 - alpha (1 - rho)).
    """
    return p.alpha * (p.rho * G + (1.0 - p.rho) * grf_expected)
