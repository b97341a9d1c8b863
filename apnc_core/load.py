"""Foot load as the circuits see it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from apnc_core.interface import Array


def normalise(grf: Array, robot_weight: float) -> tuple[Array, NDArray[np.bool_]]:
    """Load over half the weight, F(n), and the legs whose sensor reports nonsense.

    Args:
        grf: loads [N], shape (n,).
        robot_weight: weight of the robot [N].

    Returns:
        F, shape (n,), zero where the load is not finite or negative, and that fault, shape (n,).

    Source: text below Eq. 5. Pitfall: the paper says [0, 1); a foot that carries more than half
    the weight gives more than 1, and is not clipped.
    """
    fault = ~(np.isfinite(grf) & (grf >= 0.0))
    return np.where(fault, 0.0, grf) * (2.0 / robot_weight), fault
