"""The one low-pass used by the metrics: the Savitzky-Golay filter of the authors' evaluation."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import savgol_filter

WINDOW: Final = 91
ORDER: Final = 2


def smooth(values: ArrayLike, window: int = WINDOW, order: int = ORDER) -> NDArray[np.float64]:
    """Smooth along the first axis by local polynomials (91 samples, order 2, as the authors).

    Args:
        values: samples, shape (T, ...), any unit.
        window: length of the local fit [samples]; shortened to the longest odd length that fits.
        order: order of the polynomial.

    Pitfall: at 60 Hz the window spans 1.5 s. It removes most of what happens within a stride and
    delays nothing, but the first and last 0.75 s are extrapolated from a one-sided fit.
    """
    samples = np.asarray(values, dtype=np.float64)
    length = min(window, len(samples))
    length -= (length + 1) % 2
    if length <= order:
        return samples.copy()
    result: NDArray[np.float64] = savgol_filter(samples, length, order, axis=0)
    return result
