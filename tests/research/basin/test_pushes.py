"""Pushes: their size, and when one is forgotten."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from apnc import Experiment, Record, simulate
from apnc.loop.push import Push
from apnc_plant.robot import load_robot
from research.basin import pushes


def test_a_push_is_of_the_robot_s_size_and_goes_where_it_says() -> None:
    robot = load_robot("lilibot")
    size = 0.4 * robot.mass * np.sqrt(9.81 * 0.155)
    assert pushes.impulse(robot, 0.4) == pytest.approx(size)
    (push,) = pushes.experiment("apnc", 3, 0.15, 90, 0.4).pushes
    assert (push.x, push.y) == pytest.approx((0.0, size), abs=1e-12)
    assert 15.0 <= push.at < 16.0
    assert push.at != pushes.experiment("apnc", 4, 0.15, 90, 0.4).pushes[0].at
    assert push.at == pushes.experiment("apc", 3, 0.08, 45, 0.1).pushes[0].at


@pytest.fixture(scope="module")
def record() -> Record:
    return simulate(Experiment(duration=12.0, mi=0.15, engine="compiled"))


def shown(
    record: Record, lost: tuple[float, float], *, left: float = np.pi, **fields: Any
) -> dict[str, Any]:
    """Measures of a robot in its gait but for an interval; it is pushed at 4 s.

    ``left`` is how far two legs are off the gait in the interval [rad].
    """
    time = record.time
    out = (time >= lost[0]) & (time < lost[1])
    relative = np.array([0.0, np.pi, np.pi, 0.0]) - out[:, np.newaxis] * [0.0, left, left, 0.0]
    angle = 2.0 * np.pi * 1.5 * time[:, np.newaxis] + relative
    signals = {**record.signals, "o1": np.cos(angle), "o2": -np.sin(angle)}
    experiment = replace(record.experiment, pushes=(Push(4.0, 0.0, 0.6),))
    return pushes.measure(replace(record, signals=signals, experiment=experiment, **fields))


def test_a_push_is_forgotten_if_the_gait_is_back_for_good(record: Record) -> None:
    found = shown(record, (4.5, 7.0))
    assert found["in_gait"] and found["impulse"] == pytest.approx(0.6)
    assert found["returned_s"] == pytest.approx(3.0, abs=0.6)  # phases are smoothed
    assert shown(record, (20.0, 20.0))["returned_s"] == 0.0
    assert shown(record, (4.5, 12.0))["returned_s"] is None
    assert not shown(record, (2.5, 3.5))["in_gait"]
    assert shown(record, (4.5, 7.0), end="fell")["returned_s"] is None


def test_what_follows_a_push_does_not_say_that_there_was_no_gait_before(record: Record) -> None:
    found = shown(record, (4.0, 7.0), left=2.0)
    assert found["in_gait"] and found["returned_s"] == pytest.approx(3.0, abs=0.6)
    assert not shown(record, (3.5, 7.0), left=2.0)["in_gait"]


def row(froude: float, returned: int, direction: int = 0, pushed: int = 10) -> dict[str, Any]:
    cell = {"mi": "0.15", "controller": "apnc", "direction": str(direction), "froude": str(froude)}
    rest = {"impulse": 3.0 * froude, "walks": 10, "pushed": pushed, "returned": returned}
    return cell | rest | {"fell": 0, "median_s": "1.5"}


def test_the_table_ends_at_the_first_push_that_is_not_forgotten() -> None:
    rows = [row(0.1, 10), row(0.2, 9), row(0.3, 8), row(0.4, 10)]
    rows += [row(0.1, 10, 90), row(0.1, 0, 180), row(0.1, 0, 270, pushed=0)]
    cells = [line.split(" | ")[1].removesuffix(" |") for line in _lines(rows)]
    assert cells == [
        "0.60 (9/10, 1.5 s), not 0.90 (8/10)",
        "all, to 0.30 (10/10, 1.5 s)",
        "not 0.30 (0/10)",
        "no gait before the push",
    ]
    (trace,) = pushes.polar(rows)
    assert trace["theta"] == [0, 90, 180, 270, 0]
    assert trace["r"] == pytest.approx([0.6, 0.3, 0.0, 0.0, 0.6])


def _lines(rows: list[dict[str, Any]]) -> list[str]:
    return pushes.counts_table(rows).splitlines()[2:]


def test_counts_leave_out_robots_that_had_no_gait() -> None:
    cell = {"mi": 0.15, "controller": "apc", "direction": 0, "froude": 0.1, "impulse": 0.3}
    results = [
        cell | {"in_gait": True, "returned_s": 1.0, "fell": False},
        cell | {"in_gait": True, "returned_s": None, "fell": True},
        cell | {"in_gait": False, "returned_s": 2.0, "fell": False},
    ]
    (found,) = pushes.counts(results)
    assert (found["walks"], found["pushed"], found["returned"], found["fell"]) == (3, 2, 1, 1)
