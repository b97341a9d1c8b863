"""The load sensor against closed form."""

import math

import numpy as np
import pytest

from exudyn_models.robot import Sensor, load_robot
from exudyn_models.sensor.load import LoadSensor

CLEAN = Sensor(delay=0.0, time_constant=0.0, noise=0.0)


def readings(sensor: Sensor, tick: float, loads: list[float], seed: int = 0) -> np.ndarray:
    cell = LoadSensor(sensor, ("RF",), 20.0, np.random.default_rng(seed))
    return np.array(
        [cell.update((k + 1) * tick, np.array([x]), tick)[0] for k, x in enumerate(loads)]
    )


def test_without_lag_and_noise_the_load_passes() -> None:
    np.testing.assert_array_equal(readings(CLEAN, 1 / 60, [1.0, 5.0, 2.0]), [1.0, 5.0, 2.0])


@pytest.mark.parametrize("ticks", [1, 3])
def test_a_delay_of_whole_ticks_shifts_the_readings(ticks: int) -> None:
    loads = [float(k) for k in range(1, 40)]
    late = readings(Sensor(ticks / 60, 0.0, 0.0), 1 / 60, loads)
    np.testing.assert_allclose(late, [0.0] * ticks + loads[:-ticks], atol=1e-9)


def test_a_delay_of_half_a_tick_more_is_interpolated() -> None:
    loads = [float(k) for k in range(1, 40)]
    late = readings(Sensor(2.5 / 60, 0.0, 0.0), 1 / 60, loads)
    np.testing.assert_allclose(late[5:], np.array(loads[5:]) - 2.5, atol=1e-9)


def test_the_low_pass_takes_six_tenths_per_tick_at_60_hz() -> None:
    constant = load_robot("lilibot").sensor.time_constant
    step = readings(Sensor(0.0, constant, 0.0), 1 / 60, [10.0] * 8)
    np.testing.assert_allclose(step, 10.0 * (1.0 - 0.4 ** np.arange(1, 9)), rtol=1e-4)


@pytest.mark.parametrize("rate", [20, 60, 240])
def test_the_low_pass_is_the_same_filter_at_every_tick_rate(rate: int) -> None:
    step = readings(Sensor(0.0, 0.05, 0.0), 1 / rate, [10.0] * (rate // 10))
    assert step[-1] == pytest.approx(10.0 * (1.0 - math.exp(-2.0)), rel=1e-9)


def test_noise_has_the_stated_size_and_is_seeded() -> None:
    noisy = Sensor(0.0, 0.0, 0.02)
    loads = [15.0] * 20000
    first = readings(noisy, 1 / 60, loads, seed=1)
    assert first.mean() == pytest.approx(15.0, abs=0.01)
    assert first.std() == pytest.approx(0.02 * 20.0 / 2.0, rel=0.03)
    np.testing.assert_array_equal(first, readings(noisy, 1 / 60, loads, seed=1))
    assert not np.array_equal(first, readings(noisy, 1 / 60, loads, seed=2))


def test_noise_never_makes_a_load_negative() -> None:
    noisy = readings(Sensor(0.0, 0.0, 0.02), 1 / 60, [0.0] * 1000)
    assert noisy.min() == 0.0
    assert noisy.max() > 0.0
