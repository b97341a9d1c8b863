"""The plant in MuJoCo: the equations of motion of Exudyn's."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from full_robot import full_robot
from made_up_robots import every_chain
from odd_robot import odd_robot
from unchecked import any_step

from apnc_plant.conditions import Conditions, named_conditions
from apnc_plant.ground import Obstacles, Plane
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.signals import PlantError
from exudyn_models.plant import ExudynPlant

pytest.importorskip("mujoco")

import own_contact_mujoco

from apnc_plant.legged import LeggedPlant
from mujoco_models.engine import mj
from mujoco_models.plant import MujocoPlant

TICK = 1 / 60
ROBOT = load_robot("lilibot")


def massless() -> RobotDescription:
    """Lilibot with hips that only join trunk and femur."""
    legs = tuple(replace(leg, hip=replace(leg.hip, mass=0.0)) for leg in ROBOT.legs)
    return replace(ROBOT, name="massless", legs=legs)


ROBOTS = [ROBOT, load_robot("hexapod"), odd_robot(), full_robot(), massless(), every_chain()]


def mass_matrices(robot: RobotDescription, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mass matrix at coordinates of the tree in MuJoCo and in Exudyn."""
    conditions = Conditions(payload=0.7)
    ours = MujocoPlant(robot, 3, conditions=conditions)._engine
    ours.data.qpos[:] = q
    mj().mj_forward(ours.model, ours.data)
    theirs = ExudynPlant(robot, 3, conditions=conditions)._engine
    theirs.mbs.systemData.SetODE2Coordinates(q)
    return ours.mass_matrix(), theirs.mass_matrix()


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)
def test_the_mass_matrix_is_that_of_exudyn(robot: RobotDescription) -> None:
    size = 6 + 3 * len(robot.legs)
    for q in np.random.default_rng(0).uniform(-0.8, 0.8, (3, size)):
        ours, theirs = mass_matrices(robot, q)
        np.testing.assert_allclose(ours, theirs, atol=1e-9)


def test_seed_conditions_and_sensor_are_those_of_every_plant() -> None:
    fine, ground = PlantOptions(step=TICK / 512), Obstacles(roughness=0.5, seed=2)
    ours, theirs = (
        P(ROBOT, 5, options=fine, conditions=named_conditions("C4", ROBOT), ground=ground)
        for P in (MujocoPlant, ExudynPlant)
    )
    assert (ours.legs, ours.mass) == (theirs.legs, theirs.mass)
    np.testing.assert_array_equal(ours.sample()["position"], theirs.sample()["position"])
    for _ in range(4):
        for plant in (ours, theirs):
            plant.advance(np.full(4, 0.05), np.full(4, -0.05), TICK)
    for name, value in ours.sample().items():
        np.testing.assert_allclose(value, theirs.sample()[name], atol=0.02, err_msg=name)
    assert (ours.grf() > 1.0).all()


@pytest.mark.parametrize("kind", [MujocoPlant, own_contact_mujoco.Plant], ids=["ours", "its own"])
@pytest.mark.parametrize("slope", [0.0, 0.1])
def test_it_stands_on_a_plane_and_the_feet_carry_its_weight(
    kind: type[LeggedPlant], slope: float
) -> None:
    plant = kind(ROBOT, ground=Plane(slope=slope))
    for _ in range(180):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    sample = plant.sample()
    total = sample["foot_force"].sum(axis=0)
    np.testing.assert_allclose(total, [0.0, 0.0, ROBOT.weight], atol=0.02)
    normal = sample["foot_force"] @ Plane(slope=slope).rotation()[:, 2]
    np.testing.assert_allclose(plant._felt_load(), normal, rtol=1e-9)
    sunk = [
        each[3]
        for foot in sample["foot_position"] @ Plane(slope=slope).rotation()
        for each in Plane().contacts(foot, ROBOT.contact.foot_radius)
    ]
    np.testing.assert_allclose(sunk, normal / ROBOT.contact.stiffness, rtol=0.02)
    # on a slope a regularised friction creeps, at v_reg tan(a) / mu if the load is half a weight
    expected = ROBOT.contact.friction_speed * math.tan(slope) / ROBOT.contact.friction
    creep = np.linalg.norm(sample["velocity"])
    # own contact: the viscosity of half a weight per foot, four feet instead of two
    share = 1.0 if kind is MujocoPlant else 0.5 * math.cos(slope)
    assert creep == pytest.approx(share * expected, rel=0.03, abs=1e-5)


def test_a_sliding_foot_gets_no_extra_normal_force() -> None:
    """With the damping of the normal direction along the ground it would get hundreds of N s/m."""
    slippery = replace(ROBOT, contact=replace(ROBOT.contact, friction=0.1))
    plant = own_contact_mujoco.Plant(slippery, ground=Plane(slope=0.3))
    for _ in range(60):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    assert np.linalg.norm(plant.sample()["velocity"]) > 1.0
    pressed = plant._felt_load().sum()
    assert pressed == pytest.approx(ROBOT.weight * math.cos(0.3), rel=0.03)


def test_a_held_trunk_hangs_and_is_let_go() -> None:
    plant = MujocoPlant(ROBOT, conditions=named_conditions("S1", ROBOT))
    for _ in range(60):
        plant.advance(np.full(4, 0.1), np.full(4, 0.1), TICK)
    assert not plant.sample()["foot_force"].any()
    plant.set_conditions(Conditions())
    for _ in range(60):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    assert plant.sample()["foot_force"][:, 2].sum() == pytest.approx(ROBOT.weight, rel=0.01)


def test_a_motion_that_breaks_down_is_said_and_leaves_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its warnings into the working folder
    any_step(monkeypatch)
    plant = MujocoPlant(ROBOT, options=PlantOptions(step=TICK))
    with pytest.raises(PlantError, match="the motion diverged before t = "):
        for tick in range(600):
            plant.advance(np.full(4, math.sin(tick)), np.full(4, math.cos(tick)), TICK)
    assert not list(tmp_path.iterdir())


def test_the_same_commands_give_the_same_motion_bit_for_bit() -> None:
    plants = [MujocoPlant(ROBOT, 1), MujocoPlant(ROBOT, 1), MujocoPlant(ROBOT, 2)]
    for plant in plants:
        for tick in range(30):
            plant.advance(np.full(4, 0.1 * math.sin(tick)), np.full(4, 0.1), TICK)
    first, again, other = (plant.sample()["position"] for plant in plants)
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()
