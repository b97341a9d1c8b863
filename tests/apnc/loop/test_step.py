"""The integration step of a walk: that of the robot, fine enough, and how a run ends without it."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from made_up_robots import heavy, stiff_kneed
from unchecked import any_step

from apnc import Experiment, simulate
from apnc.loop.record import End
from apnc_plant.compiled import CompiledPlant
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.signals import PlantError
from apnc_plant.step import longest_step, own_step

ROBOTS = [*map(load_robot, ("lilibot", "hexapod", "octopod")), stiff_kneed(), heavy()]

WAY, PATTERN = 0.1, 0.97
"""Two walks are the same if their places are apart by at most this part of the way, and at least
this share of their feet is on the ground, or in the air, at the same time."""

each_robot = pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)


class Walk(NamedTuple):
    """Two seconds of a walk: places of the trunk [m] and which feet carry, sample by sample."""

    place: np.ndarray
    loaded: np.ndarray


def rate_of(robot: RobotDescription) -> float:
    """Update rate at which a robot moves as Lilibot does at 60 Hz (equal Froude numbers) [Hz]."""
    length = robot.legs[0].femur_length + robot.legs[0].tibia_length
    return 60.0 * math.sqrt(0.155 / length)


def commands(robot: RobotDescription) -> tuple[np.ndarray, np.ndarray, float]:
    """Commands of hip and knee in the last two seconds of a walk, and the time of a tick [s]."""
    experiment = Experiment(
        robot=robot, duration=4.0, mi=0.15, rate=rate_of(robot), engine="compiled"
    )
    signals, ticks = simulate(experiment).signals, round(2.0 * experiment.rate)
    return signals["theta_hip"][-ticks:], signals["theta_knee"][-ticks:], experiment.Ts


def walked(robot: RobotDescription, step: float) -> Walk:
    """The robot under these commands, which do not depend on where its feet are."""
    hip, knee, Ts = commands(robot)
    plant = CompiledPlant(robot, options=PlantOptions(step=step))
    place, loaded = [], []
    for tick in range(len(hip)):
        plant.advance(hip[tick], knee[tick], Ts)
        sample = plant.sample()
        place.append(sample["position"])
        loaded.append(sample["foot_force"][:, 2] > 0.05 * robot.weight)
    return Walk(np.array(place), np.array(loaded))


def same(walk: Walk, finer: Walk) -> bool:
    way = np.linalg.norm(finer.place[-1] - finer.place[0])
    apart = np.linalg.norm(walk.place - finer.place, axis=1).max()
    return bool(apart < WAY * way and (walk.loaded == finer.loaded).mean() > PATTERN)


@each_robot
def test_a_walk_with_half_the_step_is_the_same(robot: RobotDescription) -> None:
    step = own_step(robot)
    assert same(walked(robot, step), walked(robot, step / 2.0))


@each_robot
def test_a_walk_with_twice_the_longest_step_is_not_the_same(
    robot: RobotDescription, monkeypatch: pytest.MonkeyPatch
) -> None:
    any_step(monkeypatch)
    finer = walked(robot, own_step(robot) / 2.0)
    try:
        assert not same(walked(robot, 2.0 * longest_step(robot)), finer)
    except PlantError as diverged:
        assert "diverged" in str(diverged)


@each_robot
def test_an_experiment_has_the_step_of_its_robot(robot: RobotDescription) -> None:
    experiment = Experiment(robot=robot)
    assert experiment.step == own_step(robot)
    assert "step" not in experiment.changed()
    assert replace(experiment, step=experiment.step / 2.0).changed()["step"] < own_step(robot)
    stored = json.loads(json.dumps(experiment.to_dict()))
    assert Experiment.from_dict(stored) == experiment


def test_an_experiment_refuses_a_step_that_is_too_long() -> None:
    for robot in ROBOTS:
        longest = longest_step(robot)
        assert Experiment(robot=robot, step=longest).step == longest
        with pytest.raises(ValueError, match=f"too long for the servos and feet of .*{robot.name}"):
            Experiment(robot=robot, step=1.001 * longest)


@pytest.mark.parametrize("engine", ["compiled", "exudyn"])
@pytest.mark.parametrize(
    ("robot", "step"),
    [("lilibot", 1 / 120), ("lilibot", 1 / 200), (stiff_kneed(), 1 / 960), (heavy(), 1 / 240)],
    ids=lambda value: getattr(value, "name", None),
)
def test_a_motion_that_diverges_is_no_fall(
    engine: str, robot: str | RobotDescription, step: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    any_step(monkeypatch)
    record = simulate(Experiment(robot=robot, step=step, engine=engine, mi=0.15, duration=20.0))
    assert record.end is End.diverged
    assert record.message.endswith(f"with integration steps of {step:.4g} s")


def test_a_robot_that_falls_has_fallen() -> None:
    experiment = Experiment(settings={"b1": 1.2, "b2": -1.0}, duration=5.0, engine="compiled")
    assert simulate(experiment).end is End.fell
