"""The exported robots in other people's loaders: each reads the same robot."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import pi
from pathlib import Path

import numpy as np
import pytest
from full_robot import full_robot
from loaders import (
    Drake,
    Loaded,
    Mujoco,
    Pinocchio,
    PyBullet,
    Simulated,
    Urchin,
    Yourdfpy,
    legs_of,
)
from odd_robot import odd_robot

from apnc_plant.compiled import CompiledPlant
from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.links import links_of
from apnc_plant.robot.names import plain_names
from apnc_plant.robot.urdf import robot_urdf
from apnc_plant.signals import JOINTS

ROBOTS = {robot.name: robot for robot in (load_robot("lilibot"), load_robot("hexapod"))}
ROBOTS |= {"odd": odd_robot(), "full": full_robot()}
ROBOTS["strange names"] = replace(
    ROBOTS["odd"],
    name="sub/../../x",
    legs=tuple(
        replace(leg, name=name)
        for leg, name in zip(ROBOTS["odd"].legs, ("a b", "a,b", "../c", "1<&\"'ü"), strict=True)
    ),
)

LOADERS: dict[str, tuple[type[Loaded], str]] = {
    "MuJoCo, MJCF": (Mujoco, "mjcf"),
    "MuJoCo, URDF": (Mujoco, "trunk"),
    "MuJoCo, URDF from base": (Mujoco, "base"),
    "Pinocchio, MJCF": (Pinocchio, "mjcf"),
    "Pinocchio, URDF": (Pinocchio, "trunk"),
    "Pinocchio, URDF from base": (Pinocchio, "base"),
    "Drake, MJCF": (Drake, "mjcf"),
    "Drake, URDF": (Drake, "trunk"),
    "Drake, URDF from base": (Drake, "base"),
    "yourdfpy": (Yourdfpy, "trunk"),
    "yourdfpy from base": (Yourdfpy, "base"),
    "urchin": (Urchin, "trunk"),
    "PyBullet": (PyBullet, "trunk"),
}


@cache
def text_of(robot: str, form: str) -> str:
    if form != "mjcf":
        return robot_urdf(ROBOTS[robot], root=form)
    pytest.importorskip("mujoco")
    from mujoco_models.tree import export_mjcf  # noqa: PLC0415

    return export_mjcf(ROBOTS[robot])


def loaded(loader: str, robot: str, folder: Path) -> Loaded:
    kind, form = LOADERS[loader]
    return kind(text_of(robot, form), folder, ROBOTS[robot].servo)


def names_of(robot: RobotDescription) -> list[str]:
    """Joints of the file, in its order."""
    legs = plain_names(leg.name for leg in robot.legs)
    joints = [link.joint for link in links_of(robot.legs[0])]
    return [f"{leg}_{joint}" for leg in legs for joint in joints]


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("loader", LOADERS)
def test_a_loader_has_our_mass_joints_limits_and_feet(
    loader: str, robot: str, tmp_path: Path
) -> None:
    found, ours = loaded(loader, robot, tmp_path), ROBOTS[robot]
    assert found.mass == pytest.approx(ours.mass, abs=1e-9)
    names = names_of(ours)
    if loader.startswith("Pinocchio, URDF"):
        legs = [(name, *name.rsplit("_", 1)) for name in names]
        legs.sort(key=lambda each: (f"{each[1]}_abduction", names.index(each[0])))
        assert found.joints == [name for name, _, _ in legs]  # legs by name
    elif loader == "urchin":  # by depth; which leg comes first depends on the processor
        assert sorted(found.joints) == sorted(names)
        kinds = [name.rsplit("_", 1)[1] for name in found.joints]
        assert kinds == sorted(kinds, key=("abduction", "hip", "knee").index)
    else:
        assert found.joints == names
    joints = [(leg, link.angle) for leg in ours.legs for link in links_of(leg)]
    for name, (leg, joint) in zip(names, joints, strict=True):
        servo, (low, high) = ours.servo_of(leg, JOINTS[joint]), leg.stops[joint]
        lower, upper, torque, speed = found.limits[name]
        assert (lower, upper) == pytest.approx((max(low, -pi), min(high, pi)), abs=1e-12)
        assert torque == pytest.approx(servo.stall_torque, abs=1e-12)
        assert speed is None or speed == pytest.approx(servo.no_load_speed, abs=1e-12)
    random = np.random.default_rng(0)
    legs = plain_names(leg.name for leg in ours.legs)
    assert sorted(legs_of(found.joints)) == sorted(legs)
    for angles in (np.zeros((len(legs), 3)), *random.uniform(-1.5, 1.5, (3, len(legs), 3))):
        feet = found.feet(dict(zip(names, angles.ravel(), strict=True)))
        for leg, foot in zip(legs, Kinematics(ours).feet(angles), strict=True):
            np.testing.assert_allclose(feet[leg], foot, atol=1e-9)


@cache
def standing(robot: str) -> float:
    """Height of the trunk [m] after a second in our own plant, its servos at 0."""
    plant = CompiledPlant(ROBOTS[robot])
    for _ in range(60):
        plant.advance(*np.zeros((2, len(plant.legs))), 1.0 / 60.0)
    return float(plant.sample()["position"][2])


SIMULATORS = [name for name, (kind, _) in LOADERS.items() if issubclass(kind, Simulated)]


@pytest.mark.parametrize("robot", ["lilibot", "hexapod"])
@pytest.mark.parametrize("loader", SIMULATORS)
def test_a_robot_stands_on_its_feet(loader: str, robot: str, tmp_path: Path) -> None:
    found = loaded(loader, robot, tmp_path)
    assert isinstance(found, Simulated)
    height = standing(robot)
    rest = found.rest(height + 0.003, 0.0)
    # PyBullet's servos hold their angle without a spring
    assert rest.height == pytest.approx(height, abs=0.005)
    assert rest.load == pytest.approx(ROBOTS[robot].weight, rel=0.02)


@pytest.mark.parametrize("loader", SIMULATORS)
def test_a_robot_that_falls_on_its_back_does_not_sink_in(loader: str, tmp_path: Path) -> None:
    found, trunk = loaded(loader, "lilibot", tmp_path), ROBOTS["lilibot"].trunk
    assert isinstance(found, Simulated)
    top = trunk.center[2] + trunk.edges[2] / 2.0
    rest = found.rest(top + 0.01, pi)
    assert rest.height == pytest.approx(top, abs=0.003)
