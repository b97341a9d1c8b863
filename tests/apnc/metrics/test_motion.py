"""Motion of the trunk on lines, curves and sines."""

from __future__ import annotations

import numpy as np
import pytest

from apnc import metrics

PI = np.pi
T = np.arange(1201) / 60


def test_net_displacement_is_along_the_initial_heading() -> None:
    position = np.column_stack([1 + 0.3 * T, 2 + 0.4 * T, 5 * T])
    ahead = np.arctan2(4, 3)
    for yaw, distance in ((ahead, 10.0), (0.0, 6.0), (PI / 2, 8.0), (ahead + PI, -10.0)):
        found = metrics.forward_distance(position, yaw + 0.1 * T)
        assert found == pytest.approx(distance)
    assert metrics.path_length(position) == pytest.approx(10.0)


def test_sway_is_no_distance() -> None:
    position = np.column_stack([0.1 * T, 0.01 * np.sin(2 * PI * 2 * T), 0 * T])
    assert metrics.path_length(position) == pytest.approx(2.0, rel=0.02)


def test_a_circle_shows_in_the_path_only() -> None:
    angle = 2 * PI * T / 20
    position = np.column_stack([np.sin(angle), 1 - np.cos(angle), 0 * T])
    assert metrics.forward_distance(position, angle) == pytest.approx(0.0, abs=1e-9)
    assert metrics.path_length(position) == pytest.approx(2 * PI, rel=0.01)
    heading = metrics.wrap(angle)
    speed = metrics.smoothed_speed(T, position, heading)
    # Near the jump of the wrapped yaw too, and at the ends but for the one-sided fit.
    assert speed == pytest.approx(2 * PI / 20, rel=0.03)
    assert metrics.smoothed_speed(T, position, heading + PI / 2)[600] == pytest.approx(0, abs=0.005)
    assert metrics.turned(heading) == pytest.approx(2 * PI)


@pytest.mark.parametrize("speed", [0.1, -0.1])
def test_smoothed_speed_is_along_the_heading(speed: float) -> None:
    for yaw in (0.0, 0.5, 2.0, -3.0):
        sway = 0.01 * np.sin(2 * PI * 3 * T)
        along = speed * T + sway
        position = np.column_stack([along * np.cos(yaw), along * np.sin(yaw), 0.2 * T])
        found = metrics.smoothed_speed(T, position, yaw + 20 * sway)
        assert found[60:-60] == pytest.approx(speed, abs=0.02)


def test_smoothed_speed_is_per_second_of_the_time_axis() -> None:
    position = np.column_stack([T, 0 * T, 0 * T])
    assert metrics.smoothed_speed(2 * T, position, 0 * T) == pytest.approx(0.5)


def test_turning_more_than_half_a_turn() -> None:
    yaw = metrics.wrap(np.linspace(0.5, 0.5 + 3 * PI, 500))
    assert metrics.turned(yaw) == pytest.approx(3 * PI)
    assert metrics.turned(-yaw) == pytest.approx(-3 * PI)
    assert metrics.turned(np.empty(0)) is None


def test_too_short_to_have_moved() -> None:
    for samples in (0, 1):
        position, yaw = np.zeros((samples, 3)), np.zeros(samples)
        assert metrics.forward_distance(position, yaw) is None
        assert metrics.path_length(position) is None
        speed = metrics.smoothed_speed(yaw, position, yaw)
        assert len(speed) == samples and np.isnan(speed).all()
    two = np.array([[0.0, 0, 0], [3.0, 4.0, 9.0]])
    assert metrics.path_length(two) == pytest.approx(5.0)
    assert metrics.forward_distance(two, np.zeros(2)) == pytest.approx(3.0)
    assert metrics.smoothed_speed(np.array([0, 2.0]), two, np.zeros(2)) == pytest.approx(1.5)


def test_mean_speed() -> None:
    assert metrics.mean_speed(np.array([2.0, 3.0, 6.0]), 8.0) == pytest.approx(2.0)
    assert metrics.mean_speed(np.array([2.0]), None) is None


def test_balance_of_sines() -> None:
    t = np.arange(600) / 60
    roll, pitch = 0.02 * np.sin(2 * PI * t), 0.3 + 0.01 * np.sin(4 * PI * t)
    assert metrics.balance(roll, pitch, 0.1) == pytest.approx(np.sqrt(2) * (50 + 100))
    assert metrics.balance(roll, 0 * pitch, 0.1) is None
    assert metrics.balance(0 * roll, pitch, 0.1) is None


def test_a_robot_that_stands_has_no_balance() -> None:
    roll = 1e-4 * np.sin(np.arange(600.0))
    for speed in (None, 0.0, 0.0049):
        assert metrics.balance(roll, roll, speed) is None
    assert metrics.balance(roll, roll, 0.005) == pytest.approx(2 * np.sqrt(2) / 1e-4, rel=0.01)


def test_cost_of_transport_of_constant_power() -> None:
    t = 5.0 + np.arange(601) / 60
    # 1.5 W and 0.5 W for 10 s over 2.5 kg * 9.81 m/s^2 * 4 m; what was spent before does not count
    work = np.stack([1.5 * t, 0.5 * t + 3.0], axis=1).reshape(601, 1, 2)
    expected = 20 / (2.5 * 9.81 * 4)
    assert metrics.cost_of_transport(t, work, 2.5, 4.0) == pytest.approx(expected)
    assert metrics.cost_of_transport(t, work, 2.5, 0.05) == pytest.approx(80 * expected)
    assert metrics.cost_of_transport(t, work, 2.5, 0.0499) is None
    assert metrics.cost_of_transport(t, work, 2.5, None) is None
