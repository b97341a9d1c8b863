"""The elementary functions against the system's in extended precision, over their whole range."""

from __future__ import annotations

import math

import numpy as np
import pytest

from apnc_core.elementary import MAX_ERROR, angle_of, cos_unit, sin_cos, sin_unit, tanh, total

Long = np.longdouble
if np.finfo(Long).nmant < 63:
    pytest.skip("long double is no longer than double here", allow_module_level=True)

TINY = np.concatenate([np.geomspace(5e-324, 1e-3, 3000), [2.2e-308, 1e-16, 1e-8]])
EVERYWHERE = np.random.default_rng(1).uniform(0.0, 1.0, 300_000)


def symmetric(*parts: np.ndarray) -> np.ndarray:
    x = np.concatenate(parts)
    return np.concatenate([-x, x])


def beside(x: np.ndarray, steps: int = 20) -> np.ndarray:
    """Numbers within some last places of x."""
    return np.concatenate([x + k * np.spacing(x) for k in range(-steps, steps + 1)])


def error(value: np.ndarray, true: np.ndarray) -> float:
    """Largest relative error; below the normal numbers one last place counts as exact."""
    off = np.abs(value.astype(Long) - true)
    off[off <= Long(5e-324)] = 0
    return float(np.max(off / np.maximum(np.abs(true), Long(1e-323))))


def test_errors_are_a_thousandth_of_what_is_asked() -> None:
    assert max(MAX_ERROR.values()) <= 1e-12 / 1000


def test_tanh() -> None:
    # the power of two changes at odd multiples of ln(2) / 4, and 20 is the end
    changes = np.arange(1, 117, 2) * (math.log(2.0) / 4)
    ends = np.array([19.99, 20.0, 20.01, 22.0, 700.0, 1e300])
    x = symmetric(EVERYWHERE, 22.0 * EVERYWHERE, TINY, beside(changes), beside(ends), [math.inf])
    value = tanh(x)
    assert error(value, np.tanh(x.astype(Long))) < MAX_ERROR["tanh"]
    assert np.abs(value).max() == 1.0
    np.testing.assert_array_equal(tanh(-x), -value)


def test_sine_and_cosine_of_neuron_outputs() -> None:
    x = symmetric(EVERYWHERE, TINY, [1.0, np.nextafter(1.0, 0.0)])
    assert error(sin_unit(x), np.sin(x.astype(Long))) < MAX_ERROR["sin"]
    assert error(cos_unit(x), np.cos(x.astype(Long))) < MAX_ERROR["cos"]


def test_sine_and_cosine_of_phases() -> None:
    quarters = np.arange(1, 17) * (0.5 * math.pi)
    x = symmetric(25.0 * EVERYWHERE, TINY, beside(quarters), beside(quarters - 0.25 * math.pi))
    sine, cosine = sin_cos(x)
    assert error(sine, np.sin(x.astype(Long))) < MAX_ERROR["sin"]
    assert error(cosine, np.cos(x.astype(Long))) < MAX_ERROR["cos"]


def test_angle_of_a_vector() -> None:
    turn = 2.0 * math.pi * EVERYWHERE
    eighths = beside(np.arange(1, 16) * (math.pi / 8.0))
    directions = np.concatenate([turn, eighths])
    length = np.geomspace(1e-200, 1e200, directions.size)
    y = np.concatenate([length * np.sin(directions), TINY, np.ones_like(TINY)])
    x = np.concatenate([length * np.cos(directions), np.ones_like(TINY), TINY])
    assert error(angle_of(y, x), np.arctan2(y.astype(Long), x.astype(Long))) < MAX_ERROR["angle_of"]


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 63, 64])
def test_total_is_the_sum(n: int) -> None:
    x = np.random.default_rng(n).normal(size=n)
    assert total(x) == pytest.approx(math.fsum(x), abs=1e-14)
