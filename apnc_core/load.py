"""Load of a foot over half the weight, as the circuits receive it."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc_core.types import Array

MOST_WEIGHTS: Final = 1000.0
"""Loads above this many weights are faults, such as the reading of a sensor with a broken wire."""


def normalise(grf: Array, robot_weight: float, F_max: float) -> tuple[Array, NDArray[np.bool_]]:
    """Load over half the weight, F(n), and the legs whose load cannot be used.

    Args:
        grf: loads [N], shape (n,).
        robot_weight: weight of the robot [N].
        F_max: largest F that the circuits see [1].

    Returns:
        F, shape (n,), zero where the load is not finite, negative or beyond ``MOST_WEIGHTS``, and
        that fault, shape (n,).

    F = min(grf / (robot_weight / 2), F_max); the paper normalises to [0, 1) (text below Eq. 5).
    Pitfall: without the limit a payload or an impact raises gamma F until the oscillator stops.
    """
    fault = ~((grf >= 0.0) & (grf <= MOST_WEIGHTS * robot_weight))
    return np.minimum(np.where(fault, 0.0, grf) * (2.0 / robot_weight), F_max), fault
