"""A robot in another stance: where its feet are, and which angles say so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from apnc import importing
from apnc.tune.stance import StanceChange, _foot, stood
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.model import JointInFile, JointsInFile
from apnc_plant.robot.size import mean_leg_length

STANCE = StanceChange(up=0.04, back=0.05, apart=0.06, fore_up=0.02)
B = (-0.43, 0.18)


@pytest.fixture
def robot() -> RobotDescription:
    robot = load_robot(Path(importing.__file__).with_name("reference.toml"))  # legs alike
    joints = JointsInFile(
        hip=JointInFile("thigh", -1, robot.legs[0].femur_angle),
        knee=JointInFile("calf", -1, -robot.legs[0].tibia_angle),
    )
    return replace(robot, legs=(replace(robot.legs[0], joints=joints), *robot.legs[1:]))


def test_the_feet_stand_where_the_stance_says(robot: RobotDescription) -> None:
    found, b = stood(robot, B, STANCE)
    L = mean_leg_length(robot)
    for before, after in zip(robot.legs, found.legs, strict=True):
        end = np.sign(before.mount[0])
        (x0, z0), (x1, z1) = _foot(before, *B), _foot(after, *b)
        assert x1 - x0 == pytest.approx(L * (end * STANCE.apart - STANCE.back), abs=1e-12)
        assert z1 - z0 == pytest.approx(L * (STANCE.up + 0.5 * end * STANCE.fore_up), abs=1e-12)


def test_a_change_that_all_legs_share_leaves_the_reference_pose(robot: RobotDescription) -> None:
    found, b = stood(robot, B, StanceChange(up=0.05, back=0.1))
    assert found == robot
    assert b != pytest.approx(B)


def test_offsets_that_are_kept_leave_the_same_stance(robot: RobotDescription) -> None:
    free, b = stood(robot, B, STANCE)
    kept, same = stood(robot, B, STANCE, keep=True)
    assert same == B != b
    for one, other in zip(free.legs, kept.legs, strict=True):
        assert _foot(other, *B) == pytest.approx(_foot(one, *b), abs=1e-12)


def test_joints_of_the_model_file_keep_their_angles(robot: RobotDescription) -> None:
    found, _ = stood(robot, B, STANCE)
    leg, own = robot.legs[0], found.legs[0]
    assert own.femur_angle != pytest.approx(leg.femur_angle)
    assert own.joints.hip is not None and own.joints.knee is not None
    # in that file the thigh is at the angle of the femur and the calf at minus that of the tibia
    assert own.joints.hip.offset == pytest.approx(own.femur_angle)
    assert own.joints.knee.offset == pytest.approx(-own.tibia_angle)


def test_reference_angles_stay_between_the_stops(robot: RobotDescription) -> None:
    legs = tuple(
        replace(leg, femur_range=(leg.femur_angle - 0.05, leg.femur_angle + 0.05))
        for leg in robot.legs
    )
    found, _ = stood(replace(robot, legs=legs), B, StanceChange(apart=0.12))
    for leg in found.legs:
        assert leg.femur_range is not None
        assert leg.femur_range[0] < leg.femur_angle < leg.femur_range[1]
