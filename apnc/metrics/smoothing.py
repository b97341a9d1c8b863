"""The one low-pass used by the metrics: the Savitzky-Golay filter of the authors' evaluation."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

Array = NDArray[np.float64]

WINDOW: Final = 91
ORDER: Final = 2


def smooth(values: Array) -> Array:
    """Smooth (T, ...) along time by local parabolas over 91 samples, or the longest odd number.

    Pitfall: at 60 Hz the window spans 1.5 s. It removes most of what happens within a stride and
    delays nothing, but the first and last 0.75 s are extrapolated from a one-sided fit.
    """
    length = min(WINDOW, len(values) - 1 + len(values) % 2)
    if length <= ORDER:
        return values.copy()
    result: Array = savgol_filter(values, length, ORDER, axis=0)
    return result
