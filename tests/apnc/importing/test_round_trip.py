"""Our own robots, exported and read back, are the same robots."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from full_robot import full_robot

from apnc.importing import ImportedRobot, import_robot
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.urdf import ROOTS, robot_urdf
from apnc_plant.signals import JOINTS

ROBOTS = {name: load_robot(name) for name in ("lilibot", "hexapod", "octopod")}
ROBOTS["full"] = full_robot()


def assert_same(found: ImportedRobot, own: RobotDescription) -> None:
    read = found.robot

    def same(a: object, b: object) -> None:
        np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-12)

    same(read.mass, own.mass)
    same(read.trunk.inertia_tensor(), own.trunk.inertia_tensor())
    same(read.trunk.com, own.trunk.com)
    same(read.trunk.corners(), own.trunk.corners())
    assert [leg.name for leg in read.legs] == [leg.name for leg in own.legs]
    for a, b in zip(read.legs, own.legs, strict=True):
        for name in ("mount", "hip_offset", "femur_length", "tibia_length",
                     "femur_angle", "tibia_angle", "stops"):  # fmt: skip
            same(getattr(a, name), getattr(b, name))
        for name in ("hip", "femur", "tibia"):
            link, original = getattr(a, name), getattr(b, name)
            same(link.mass, original.mass)
            same(link.com, original.com)
            same(link.inertia_tensor(), original.inertia_tensor())
        for joint in JOINTS:
            for name in ("stall_torque", "no_load_speed", "stiffness", "damping",
                         "reflected_inertia", "joint_damping", "dry_friction"):  # fmt: skip
                servos = read.servo_of(a, joint), own.servo_of(b, joint)
                same(*(getattr(servo, name) for servo in servos))
    same(read.foot_radii, own.foot_radii)
    for each in found.robot.joint_map:
        assert each.sign == 1.0
        same(each.offset, 0.0)


@pytest.mark.parametrize("root", ROOTS)
@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_comes_back_from_urdf(name: str, root: str, tmp_path: Path) -> None:
    own, path = ROBOTS[name], tmp_path / "robot.urdf"
    path.write_text(robot_urdf(own, root=root))
    assert_same(import_robot(path, "zero"), own)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_comes_back_from_mjcf(name: str, tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    from mujoco_models.tree import export_mjcf  # noqa: PLC0415  # an extra

    own, path = ROBOTS[name], tmp_path / "robot.xml"
    path.write_text(export_mjcf(own))
    assert_same(import_robot(path, "stand"), own)
