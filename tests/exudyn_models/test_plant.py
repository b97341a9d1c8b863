"""The plant in Exudyn against the engine itself, and what its contact does while it walks."""

import numpy as np
import pytest
from exudyn_feet import MarkedPlant
from plain_robot import plain_robot
from plants import trot

from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.step import own_step
from exudyn_models.engine import exu
from exudyn_models.plant import ExudynPlant

TICK = 1 / 60
ROBOT = load_robot("lilibot")


def test_recorded_feet_are_where_the_engine_has_them() -> None:
    plant = MarkedPlant(ROBOT)
    for tick in range(90):
        trot(plant, tick)
    position = exu().OutputVariableType.Position
    markers = [
        plant._engine.mbs.GetMarkerOutput(foot, variableType=position)
        for foot in plant._engine.feet
    ]
    np.testing.assert_allclose(plant.sample()["foot_position"], markers, atol=1e-12)


def forces_while_walking(robot: RobotDescription, step: float) -> np.ndarray:
    """Foot forces at every step of two seconds of trot, after one to get going."""
    plant = ExudynPlant(robot, options=PlantOptions(step=step))
    for tick in range(60):
        trot(plant, tick)
    forces = []
    steps = round(TICK / step)
    for tick in range(60, 180):
        for _ in range(steps):
            trot(plant, tick, TICK / steps)
            forces.append(plant.sample()["foot_force"])
    return np.array(forces)


def chatter(forces: np.ndarray) -> float:
    """Share of loaded samples at which a lateral force turns round twice in two steps."""
    loaded = forces[2:, :, 2] > 1.0
    change = np.diff(forces[:, :, :2], axis=0)
    sharp = np.abs(change) > 0.1
    turned = (change[1:] * change[:-1] < 0.0) & sharp[1:] & sharp[:-1]
    return float((turned.any(axis=2) & loaded).sum() / loaded.sum())


def test_walking_feet_do_not_chatter_stick_to_the_ground_or_leave_the_friction_cone() -> None:
    forces = forces_while_walking(ROBOT, own_step(ROBOT))
    assert chatter(forces) < 0.01
    assert forces[:, :, 2].min() == 0.0
    loaded = forces[:, :, 2] > 1.0
    tangential = np.hypot(forces[:, :, 0], forces[:, :, 1])[loaded]
    assert (tangential <= (1.0 + 1e-9) * ROBOT.contact.friction * forces[:, :, 2][loaded]).all()


def test_chatter_would_be_seen() -> None:
    robot = plain_robot()
    assert chatter(forces_while_walking(robot, 2.0 * own_step(robot))) > 0.1


def test_the_engine_has_the_time_of_the_plant() -> None:
    plant = ExudynPlant(ROBOT)
    for duration in (TICK, 0.01, 1e-4, 0.0333, 1e-6):
        plant.advance(np.zeros(4), np.zeros(4), duration)
    assert plant._engine.mbs.systemData.GetTime() == pytest.approx(plant.time, abs=1e-12)
