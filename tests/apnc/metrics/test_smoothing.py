"""The low-pass against parabolas, a closed form and the filter of SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from records import RATE
from scipy.signal import savgol_filter

from apnc import metrics
from apnc.metrics.smoothing import ORDER, WINDOW, _weights


def test_smoothing_keeps_parabolas() -> None:
    t = np.arange(200) / RATE
    parabola = np.stack([1 + 2 * t - 3 * t**2, -t], axis=1)
    assert metrics.smooth(parabola) == pytest.approx(parabola)


@pytest.mark.parametrize(("samples", "half"), [(301, 45), (91, 45), (90, 44), (7, 3), (4, 1)])
def test_smoothing_of_one_peak(samples: int, half: int) -> None:
    peak = np.zeros(samples)
    peak[samples // 2] = 1.0
    # Weight of the middle in a local fit of a parabola to 2 half + 1 samples.
    weight = 3 * (3 * half**2 + 3 * half - 1) / ((2 * half - 1) * (2 * half + 1) * (2 * half + 3))
    smoothed = metrics.smooth(peak)
    assert smoothed[samples // 2] == pytest.approx(weight)
    assert peak[samples // 2] == 1.0


@pytest.mark.parametrize(("samples", "window"), [(3, 3), (90, 89), (91, 91), (92, 91), (400, 91)])
def test_smoothing_is_the_filter_of_the_authors(samples: int, window: int) -> None:
    values = np.random.default_rng(0).normal(size=(samples, 2, 3)).cumsum(axis=0)
    expected = savgol_filter(values, window, 2, axis=0)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(metrics.smooth(values), expected, rtol=0.0, atol=1e-12 * scale)


def test_weights_are_those_of_scipy_in_every_window() -> None:
    """Recorded figures keep their bits only if the weights are rounded as SciPy rounds them."""
    for length in range(3, WINDOW + 1, 2):
        expected = savgol_filter(np.eye(length), length, ORDER, axis=0)
        np.testing.assert_allclose(_weights(length), expected, rtol=0.0, atol=1e-15)


def test_a_value_that_is_not_finite_spoils_no_more_than_its_window() -> None:
    values = np.zeros((400, 2))
    values[200, 0] = np.nan
    assert np.flatnonzero(np.isnan(metrics.smooth(values)).any(axis=1)).tolist() == [
        *range(155, 246)
    ]
    assert not np.isnan(metrics.smooth(values)[:, 1]).any()


@pytest.mark.parametrize("samples", [0, 1, 2])
def test_too_short_to_smooth(samples: int) -> None:
    values = np.arange(float(samples))
    smoothed = metrics.smooth(values)
    assert smoothed.tolist() == values.tolist() and smoothed is not values
