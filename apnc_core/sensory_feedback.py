"""Sensory feedback: how the foot load acts on the oscillator (Eq. 5)."""

from __future__ import annotations

from apnc_core.elementary import cos_unit, sin_unit
from apnc_core.types import Array


def feedback(gamma: Array, F: Array, o1: Array, o2: Array) -> tuple[Array, Array]:
    """Feedback terms f1(n), f2(n), shape (n,), subtracted from the activations.

    Args:
        gamma: feedback gain, shape (n,).
        F: load over half the weight, shape (n,).
        o1, o2: neuron outputs, shape (n,).

    f1 = gamma F cos(o1), f2 = gamma F sin(o2) (Eq. 5).
    """
    return gamma * F * cos_unit(o1), gamma * F * sin_unit(o2)
