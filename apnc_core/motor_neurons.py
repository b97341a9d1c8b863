"""Motor neurons: from oscillator outputs to joint commands (Eq. 4)."""

from __future__ import annotations

import numpy as np

from apnc_core.interface import Parameters
from apnc_core.types import Array


def amplitude_scale(turn: float, n_legs: int, p: Parameters) -> Array:
    """Factor on the slopes of every leg, shape (n,): the right legs come first.

    Args:
        turn: steering in [-1, 1], positive turns left.
        n_legs: number of legs, the first half on the right.
        p: uses ``turn_gain``.

    1 + turn_gain turn on the right, 1 - turn_gain turn on the left. Source: section 3.3 of the
    paper, steeper slopes on the right turn the robot to the left.
    """
    right = np.arange(n_legs) < n_legs // 2
    change = p.turn_gain * turn
    return np.where(right, 1.0 + change, 1.0 - change)


def command(o1: Array, o2: Array, scale: Array, p: Parameters) -> tuple[Array, Array]:
    """Joint commands theta_hip, theta_knee [rad], shape (n,), relative to the reference pose.

    Args:
        o1, o2: neuron outputs, shape (n,).
        scale: factor on the slopes, shape (n,).
        p: uses ``a1``, ``a2`` [rad], ``b1``, ``b2`` [rad].

    theta_i = a_i o_i + b_i (Eq. 4).
    """
    return scale * p.a1 * o1 + p.b1, scale * p.a2 * o2 + p.b2
