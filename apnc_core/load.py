"""Foot load as the circuits see it."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc_core.interface import Array

MOST_WEIGHTS: Final = 1000.0
"""A load above so many times the weight is no load: a sensor shows it when its wire breaks."""


def normalise(grf: Array, robot_weight: float) -> tuple[Array, NDArray[np.bool_]]:
    """Load over half the weight, F(n), and the legs whose sensor reports nonsense.

    Args:
        grf: loads [N], shape (n,).
        robot_weight: weight of the robot [N].

    Returns:
        F, shape (n,), zero where the load is not finite, negative or beyond ``MOST_WEIGHTS``, and
        that fault, shape (n,).

    Source: text below Eq. 5. Pitfall: the paper says [0, 1); a foot that carries more than half
    the weight gives more than 1, and is not clipped.
    """
    fault = ~((grf >= 0.0) & (grf <= MOST_WEIGHTS * robot_weight))
    return np.where(fault, 0.0, grf) * (2.0 / robot_weight), fault
