"""Tegotae baseline: the feedback of Eq. 5 with a gain that does not learn.

Source: Owaki et al. (2012, 2017), in the form the paper compares with.
"""

from __future__ import annotations

import numpy as np

from apnc_core.interface import Parameters
from apnc_core.types import Array


def gain(n_legs: int, p: Parameters) -> Array:
    """Fixed feedback gain of every leg, shape (n,); uses ``gamma_tegotae``."""
    return np.full(n_legs, p.gamma_tegotae)
