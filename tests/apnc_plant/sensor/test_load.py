"""The load sensor against closed form, alone and in the plants."""

import math
from dataclasses import replace

import numpy as np
import pytest
from plants import Kind, in_both

from apnc_plant.conditions import Conditions
from apnc_plant.robot import Sensor, load_robot
from apnc_plant.sensor.load import LoadSensor

CLEAN = Sensor(delay=0.0, time_constant=0.0, noise=0.0)


def readings(sensor: Sensor, tick: float, loads: list[float], seed: int = 0) -> np.ndarray:
    cell = LoadSensor(sensor, ("RF", "LF"), 20.0, seed)
    return np.array([cell.update(np.array([x, 0.0]), tick)[0] for x in loads])


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


def cells(noise: float, legs: tuple[str, ...] = ("RF", "LF", "T")) -> LoadSensor:
    return LoadSensor(Sensor(0.0, 0.0, noise), legs, 20.0, 5)


def test_added_noise_adds_up_in_squares() -> None:
    # 3-4-5: noise of 0.03 and 0.04 of half the weight is noise of 0.05, not of 0.07.
    cell = cells(0.03)
    cell.disturb(Conditions(grf_noise=0.04))
    shown = [cell.update(np.full(3, 50.0), 1 / 60) for _ in range(1, 7000)]
    assert np.std(shown) == pytest.approx(0.05 * 10.0, rel=0.03)
    # Every foot has noise of its own.
    assert np.abs(np.corrcoef(np.transpose(shown)) - np.eye(3)).max() < 0.05


def test_noise_that_is_taken_away_again_is_gone() -> None:
    cell = cells(0.0)
    cell.disturb(Conditions(grf_noise=0.5))
    assert (cell.update(np.full(3, 50.0), 1 / 60) != 50.0).all()
    cell.disturb(Conditions())
    np.testing.assert_array_equal(cell.update(np.full(3, 50.0), 1 / 60), 50.0)


def test_stuck_and_silent_cells_show_nothing_else_and_no_noise() -> None:
    cell = cells(0.1)
    cell.disturb(Conditions(stuck={"T": 0.9, "LF": 0.5}, dropout=("LF",)))
    for _ in range(1, 20):
        shown = cell.update(np.full(3, 50.0), 1 / 60)
        np.testing.assert_array_equal(shown[1:], [0.0, 9.0])
        assert shown[0] > 40.0
    cell.disturb(Conditions(dropout=("*",)))
    np.testing.assert_array_equal(cell.update(np.full(3, 50.0), 1 / 60), 0.0)


def test_a_broken_cell_goes_on_following_the_load_unseen() -> None:
    # Mended after one time constant, it shows what a whole one would.
    cell = LoadSensor(Sensor(0.0, 0.1, 0.0), ("RF", "LF"), 20.0)
    cell.disturb(Conditions(stuck={"RF": 0.1}))
    for _ in range(1, 7):
        assert cell.update(np.array([10.0, 0.0]), 1 / 60)[0] == 1.0
    cell.disturb(Conditions())
    shown = cell.update(np.array([10.0, 0.0]), 1 / 60)[0]
    assert shown == pytest.approx(10.0 * (1.0 - math.exp(-7 / 6)))


def test_before_anything_was_measured_the_feet_are_unloaded() -> None:
    late = readings(Sensor(0.1, 0.0, 0.0), 1 / 60, [10.0] * 12)
    np.testing.assert_allclose(late[:6], 0.0, atol=1e-9)
    np.testing.assert_allclose(late[6:], 10.0)


def test_delay_and_low_pass_act_one_after_the_other() -> None:
    both = readings(Sensor(2 / 60, 0.05, 0.0), 1 / 60, [10.0] * 20)
    smooth = readings(Sensor(0.0, 0.05, 0.0), 1 / 60, [10.0] * 20)
    np.testing.assert_allclose(both[2:], smooth[:-2], atol=1e-6)
    assert both[1] < 1e-6


def test_uneven_ticks_are_interpolated_where_they_lie() -> None:
    cell = LoadSensor(Sensor(0.05, 0.0, 0.0), ("RF", "LF"), 20.0)
    time, shown = 0.0, []
    for duration in (0.01, 0.04, 0.03, 0.002, 0.05, 0.02):
        time += duration
        shown.append((time, cell.update(np.array([time, 0.0]), duration)[0]))
    for at, value in shown:
        assert value == pytest.approx(max(0.0, at - 0.05))


def test_noise_never_makes_a_load_negative() -> None:
    noisy = readings(Sensor(0.0, 0.0, 0.02), 1 / 60, [0.0] * 1000)
    assert noisy.min() == 0.0
    assert noisy.max() > 0.0


@in_both
def test_the_sensor_can_show_the_norm_of_the_force(kind: Kind) -> None:
    robot = load_robot("lilibot")
    quiet = replace(robot, sensor=replace(robot.sensor, noise=0.0))
    prompt = replace(quiet.sensor, delay=0.0, time_constant=0.0)
    readings = {}
    for component in ("normal", "norm"):
        plant = kind(replace(quiet, sensor=replace(prompt, component=component)))
        for tick in range(90):
            swing = 0.13 * math.sin(0.12 * tick) * np.array([1.0, -1.0, -1.0, 1.0])
            plant.advance(swing, 0.08 * np.cos(swing), 1 / 60)
        readings[component] = plant.grf()
        force = plant.sample()["foot_force"]
    np.testing.assert_allclose(readings["norm"], np.linalg.norm(force, axis=1), rtol=1e-12)
    np.testing.assert_allclose(readings["normal"], force[:, 2], rtol=1e-12)
    assert (readings["norm"] - readings["normal"]).max() > 0.01
