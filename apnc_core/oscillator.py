"""SO(2) oscillator: the central pattern generator of one leg (Eq. 1-3)."""

from __future__ import annotations

from apnc_core.elementary import tanh
from apnc_core.interface import Parameters
from apnc_core.types import Array


def activation(o1: Array, o2: Array, MI: float, p: Parameters) -> tuple[Array, Array]:
    """Recurrent part of the activations a1(n+1), a2(n+1).

    Args:
        o1, o2: neuron outputs o(n), shape (n,).
        MI: modulatory input.
        p: uses ``w11``, ``w12_0`` and ``bias``.

    a_i(n+1) = sum_j w_ij o_j(n), w12 = w12_0 + MI, w21 = -w12, w11 = w22 (Eq. 1, 3). Pitfall:
    the cycle is not a circle and turns clockwise in the (o1, o2) plane.
    """
    w12 = p.w12_0 + MI
    return p.w11 * o1 + w12 * o2 + p.bias, p.w11 * o2 - w12 * o1 + p.bias


def output(a: Array) -> Array:
    """Neuron outputs o = tanh(a), shape (n,) (Eq. 2)."""
    return tanh(a)
