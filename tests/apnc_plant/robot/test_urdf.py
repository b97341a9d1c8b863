"""The robot as URDF, read by yourdfpy and by MuJoCo: the same masses, the same feet."""

from __future__ import annotations

import io

import numpy as np
import pytest
from odd_robot import odd_robot

from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.links import links_of
from apnc_plant.robot.urdf import robot_urdf

ROBOTS = [load_robot("lilibot"), load_robot("hexapod"), odd_robot()]


@pytest.fixture(params=ROBOTS, ids=lambda robot: robot.name)
def robot(request: pytest.FixtureRequest) -> RobotDescription:
    return request.param


def test_links_have_our_masses_centres_and_inertias(robot: RobotDescription) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    model = yourdfpy.URDF.load(io.BytesIO(robot_urdf(robot).encode()))
    expected = {"trunk": robot.trunk.loaded(0.0, 0.0)} | {
        f"{leg.name}_{link.name}": link.body for leg in robot.legs for link in links_of(leg)
    }
    heavy = {name: link.inertial for name, link in model.link_map.items() if link.inertial}
    assert set(heavy) == set(expected)
    for name, found in heavy.items():
        assert found.mass == pytest.approx(expected[name].mass, abs=1e-12)
        np.testing.assert_allclose(found.origin[:3, 3], expected[name].com, atol=1e-12)
        np.testing.assert_allclose(found.inertia, expected[name].inertia, atol=1e-15)
    assert sum(each.mass for each in heavy.values()) == pytest.approx(robot.mass, abs=1e-12)


def test_feet_are_where_ours_are_at_any_joint_angles(robot: RobotDescription) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    model = yourdfpy.URDF.load(io.BytesIO(robot_urdf(robot).encode()))
    random = np.random.default_rng(0)
    for angles in random.uniform(-1.5, 1.5, (5, len(robot.legs), 3)):
        names = ("abduction", "hip", "knee")
        model.update_cfg(
            {
                f"{leg.name}_{joint}": angle
                for leg, own in zip(robot.legs, angles, strict=True)
                for joint, angle in zip(names, own, strict=True)
            }
        )
        for leg, ours in zip(robot.legs, Kinematics(robot).feet(angles), strict=True):
            foot = model.get_transform(f"{leg.name}_foot", "trunk")[:3, 3]
            np.testing.assert_allclose(foot, ours, atol=1e-9)


def test_a_servo_is_the_limits_of_its_joint(robot: RobotDescription) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    model = yourdfpy.URDF.load(io.BytesIO(robot_urdf(robot).encode()))
    moving = [joint for joint in model.joint_map.values() if joint.type != "fixed"]
    assert len(moving) == 3 * len(robot.legs)
    for joint in moving:
        assert joint.limit.effort == robot.servo.stall_torque
        assert joint.limit.velocity == robot.servo.no_load_speed


def test_mujoco_reads_it_too(robot: RobotDescription) -> None:
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(robot_urdf(robot))
    spec.compiler.fusestatic = False
    model = spec.compile()
    assert model.body_mass.sum() == pytest.approx(robot.mass, abs=1e-9)
    assert model.njnt == 3 * len(robot.legs)
