"""Where the animation draws trunk and legs of a made-up run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from made_up_robots import every_chain
from odd_robot import odd_robot
from records import FEMUR, TIBIA, synthetic_record
from scipy.spatial.transform import Rotation

from apnc.report.skeleton import leg_chains, trunk_corners, trunk_rotation
from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription


def test_knees_close_the_legs() -> None:
    record = synthetic_record(3.0, roll_amplitude=0.0, pitch_amplitude=0.0, yaw=0.7)
    hip1, hip2, knee, foot = np.moveaxis(leg_chains(record.robot, record.signals), 2, 0)
    assert np.linalg.norm(hip2 - hip1, axis=-1) == pytest.approx(0.03)
    assert np.linalg.norm(knee - hip2, axis=-1) == pytest.approx(FEMUR)
    # Holds only if the knee found from the angles fits the recorded foot.
    assert np.linalg.norm(foot - knee, axis=-1) == pytest.approx(TIBIA)


def test_positive_hip_and_abduction_swing_forward_and_to_the_left() -> None:
    record = synthetic_record(0.1, roll_amplitude=0.0, pitch_amplitude=0.0)
    before = leg_chains(record.robot, record.signals)[0, :, 2]
    record.signals["joint_angle"][..., :2] += 0.1
    after = leg_chains(record.robot, record.signals)[0, :, 2]
    assert np.all(after[:, 0] > before[:, 0])
    assert np.all(after[:, 1] > before[:, 1])


@pytest.mark.parametrize("points", [leg_chains, trunk_corners])
def test_pitch_and_roll_tilt_the_robot(points: Any) -> None:
    record = synthetic_record(0.1)
    lower, upper = (
        (slice(0, 2), slice(2, 4)) if points is leg_chains else (slice(0, 4), slice(4, 8))
    )
    record.signals["rpy"][:] = [0.1, 0.0, 0.0]
    z = points(record.robot, record.signals)[0][..., 2].reshape(upper.stop, -1)[:, 0]
    # Positive roll lifts the left side (y > 0): legs LF and LH, the second half of the corners.
    assert z[upper].mean() > z[lower].mean() + 0.005
    record.signals["rpy"][:] = [0.0, 0.1, 0.0]
    front, hind = ([0, 2], [1, 3]) if points is leg_chains else ([2, 3, 6, 7], [0, 1, 4, 5])
    z = points(record.robot, record.signals)[0][..., 2].reshape(upper.stop, -1)[:, 0]
    # Positive pitch lowers the nose.
    assert z[front].mean() < z[hind].mean() - 0.005


def test_trunk_rotation_turns_about_x_then_y_then_z() -> None:
    rpy = np.random.default_rng(0).uniform(-np.pi, np.pi, (50, 3))
    expected = Rotation.from_euler("xyz", rpy).as_matrix()
    np.testing.assert_allclose(trunk_rotation(rpy), expected, rtol=0.0, atol=1e-15)


def test_abduction_turns_the_leg_about_the_axis_ahead() -> None:
    record = synthetic_record(0.1, roll_amplitude=0.0, pitch_amplitude=0.0, yaw=0.0)
    record.signals["joint_angle"][..., 0] = 0.0
    straight = leg_chains(record.robot, record.signals)
    record.signals["joint_angle"][..., 0] = 0.3
    turned = leg_chains(record.robot, record.signals)
    turn = Rotation.from_rotvec([0.3, 0.0, 0.0])
    for point in (1, 2):  # hip2 and knee, against hip1
        expected = turn.apply((straight[:, :, point] - straight[:, :, 0]).reshape(-1, 3))
        found = (turned[:, :, point] - turned[:, :, 0]).reshape(-1, 3)
        np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize("robot", [odd_robot(), every_chain()], ids=lambda robot: robot.name)
def test_legs_of_every_kind_are_drawn_where_the_plant_has_them(robot: RobotDescription) -> None:
    angles = np.random.default_rng(1).uniform(-0.5, 0.5, (len(robot.legs), 3))
    points = [Kinematics(robot).points(k, *own) for k, own in enumerate(angles)]
    plant = {
        "position": np.zeros((1, 3)),
        "rpy": np.zeros((1, 3)),
        "joint_angle": angles[None],
        "foot_position": np.array(points)[None, :, 2],
    }
    found = leg_chains(robot, plant)[0]
    np.testing.assert_allclose(found[:, 0], [leg.mount for leg in robot.legs])
    np.testing.assert_allclose(found[:, 1:], points, rtol=0.0, atol=1e-12)
