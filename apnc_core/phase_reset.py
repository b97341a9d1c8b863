"""Phase-resetting baseline: touch-down restarts the cycle of the leg.

Source: Aoi et al. (2011), Nomura et al. (2009), in the form the paper compares with.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc_core.interface import Parameters
from apnc_core.types import Array

ACTIVATION_AT_TOUCH_DOWN: Final = (1.0, 0.0)
"""Activations (a1, a2) that a leg is set to when its foot touches down."""


def touched_down(F: Array, F_before: Array, p: Parameters) -> NDArray[np.bool_]:
    """Legs whose load has just risen through the threshold, shape (n,).

    Args:
        F, F_before: loads over half the weight at n and n - 1, shape (n,).
        p: uses ``grf_reset``, in quarters of the weight.
    """
    threshold = 0.5 * p.grf_reset
    return (F_before < threshold) & (threshold <= F)
