"""The low-pass of all metrics: the Savitzky-Golay filter of the authors' evaluation code."""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np

from apnc_core.types import Array

WINDOW: Final = 91
"""Length of the window [samples]."""

ORDER: Final = 2
"""Degree of the polynomial."""


def smooth(values: Array) -> Array:
    """Smooth values of shape (T, ...) along time by a parabola around each sample.

    The window has 91 samples, or the largest odd number of a shorter run. Pitfall: at 60 Hz it
    spans 1.5 s. It removes most of the motion within a stride and delays nothing, but the first and
    the last 0.75 s come from a one-sided fit.
    """
    length = min(WINDOW, len(values) - 1 + len(values) % 2)
    if length <= ORDER:
        return values.copy()
    weights, half = _weights(length), length // 2
    columns = values.reshape(len(values), -1)
    result = np.empty(columns.shape)
    for smoothed, column in zip(result.T, columns.T, strict=True):
        smoothed[half:-half] = np.correlate(column, weights[half], mode="valid")
    result[:half] = weights[:half] @ columns[:length]
    result[-half:] = weights[half + 1 :] @ columns[-length:]
    return result.reshape(values.shape)


@cache
def _weights(length: int) -> Array:
    """Weights of the samples of a window in each point of its parabola, shape (length, length).

    Inside the run, the filter takes the middle point of each parabola. At the ends it takes the
    first half of the first parabola and the last half of the last. The weights are computed once
    for each length, since a fit in every call takes longer than the filter.

    The steps are those of ``scipy.signal.savgol_filter`` with the same rounding, so that measures
    keep their bits. SciPy's module takes longer to import than a walk takes.
    """
    sample, half = np.arange(length, dtype=np.float64), length // 2
    fits = np.polyfit(sample, np.eye(length), ORDER)
    weights = np.asarray(np.polyval(fits, sample[:, np.newaxis]), dtype=np.float64)
    powers = np.vander(half - sample, ORDER + 1, increasing=True).T
    middle = np.linalg.lstsq(powers, np.eye(ORDER + 1)[0])[0]
    weights[half, half:] = middle[half:]
    weights[half, :half] = middle[:half:-1]
    return weights
