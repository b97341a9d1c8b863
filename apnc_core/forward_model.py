"""Forward model: predicts the load of a foot from the leg's own command (Eq. 10-11)."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc_core.elementary import tanh
from apnc_core.interface import Parameters
from apnc_core.types import Array

KERNEL_WIDTH: Final = 0.04
"""Square of the distance at which a kernel has fallen to 1/e. Source: Thor et al. 2020."""

_QUARTER: Final = ((0.85, 0.0), (0.87, 0.28), (0.88, 0.64), (0.57, 0.79), (0.27, 0.83))

CENTRES: Final = (
    *_QUARTER,
    *((0.0 - y, x) for x, y in _QUARTER),
    *((-x, 0.0 - y) for x, y in _QUARTER),
    *((y, -x) for x, y in _QUARTER),
)
"""Centres (o1, o2) of the kernels, on the oscillator's cycle at MI = 0.08, at equal angles."""

KERNELS: Final = len(CENTRES)

OVERLAP: Final = 1.15
"""Mean of the kernels' sum over the angle of the cycle."""


def stance_expected(theta: Array, theta_before: Array) -> Array:
    """G(n), shape (n,): 1 while the command does not rise, else 0 (Eq. 11).

    Args:
        theta, theta_before: commands at n and n - 1 [rad], shape (n,), of the hip or of the knee.

    Pitfall: the text speaks of the knee, the equation takes theta_1, the hip. The knee is a quarter
    of a cycle ahead: its command falls from mid-swing to mid-stance.
    """
    return np.where(theta <= theta_before, 1.0, 0.0)


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


def expect_learned(
    learned: Array, o1: Array, o2: Array, F: Array, p: Parameters
) -> tuple[Array, Array]:
    """Expected load over half the weight at n, shape (n,), and what is learned by n + 1.

    Args:
        learned: change of the weights since the start, shape (n, KERNELS).
        o1, o2: neuron outputs at n, shape (n,).
        F: load over half the weight at n, shape (n,); it acts on the weights only.
        p: uses ``alpha``, ``rbf_rate``.

    F^e(n) = sum_k w_k(n) phi_k(n), phi_k = exp(-|o(n) - c_k|^2 / KERNEL_WIDTH),
    w_k(n+1) = w_k(n) + rbf_rate (F(n) - F^e(n)) phi_k(n), where w_k starts at alpha / OVERLAP for
    a centre in stance, o2 < 0, and at 0 in swing: the expectation of Eq. 10-11.

    Source: section 2.1.2 names the network and gives no numbers; kernels, their number and width as
    in Thor et al. 2020, whose weights an optimiser finds over many walks. Assumed here: the rule,
    delta rule on the leg's own load, and the start. Pitfall: it learns to expect whatever load
    lasts, also that of a leg that stands when it should swing.
    """
    expected = np.zeros(len(o1))
    kernels = [_kernel(o1 - x, o2 - y) for x, y in CENTRES]
    for k, (kernel, (_, y)) in enumerate(zip(kernels, CENTRES, strict=True)):
        start = p.alpha / OVERLAP if y < 0.0 else 0.0
        expected = expected + (start + learned[:, k]) * kernel
    step = p.rbf_rate * (F - expected)
    return expected, learned + np.stack([step * kernel for kernel in kernels], axis=1)


def _kernel(d1: Array, d2: Array) -> Array:
    """exp(-(d1^2 + d2^2) / KERNEL_WIDTH), by tanh; the absolute error is 2e-16."""
    t = tanh((d1 * d1 + d2 * d2) * (0.5 / KERNEL_WIDTH))
    return (1.0 - t) / (1.0 + t)
