"""Robots with legs of every kind, exported and read back, are the same robots."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_up_robots import chained, insect

import apnc
from apnc.importing import ImportedRobot, ModelFileError, import_robot
from apnc.importing.model import NO_BODY, Frame, moved, rotation, together
from apnc_plant.robot import MassProperties, RobotDescription
from apnc_plant.robot.links import links_of
from apnc_plant.robot.model import CHAINS, Leg
from apnc_plant.robot.urdf import robot_urdf
from apnc_plant.signals import JOINTS

ROBOTS = {"-".join(chain): chained(chain) for chain in CHAINS} | {"insect": insect()}
SERVO = ("stall_torque", "no_load_speed", "stiffness", "damping", "reflected_inertia")


def placed(leg: Leg, angles: np.ndarray) -> tuple[MassProperties, np.ndarray]:
    """A leg as one body, and its foot, in the frame of the trunk at angles of a record [rad]."""
    whole, frame = NO_BODY, Frame()
    for link in links_of(leg):
        angle = link.turn + (0.0 if link.locked else link.sign * angles[link.angle])
        frame = frame @ Frame(np.array(link.position), rotation(np.array(link.axis), angle))
        whole = together(whole, moved(link.body, frame))
    return whole, frame.at(np.array([0.0, 0.0, -leg.tibia_length]))


def assert_moves_alike(read: RobotDescription, own: RobotDescription) -> None:
    random = np.random.default_rng(1)
    assert [leg.name for leg in read.legs] == [leg.name for leg in own.legs]
    assert [leg.chain for leg in read.legs] == [leg.chain for leg in own.legs]
    for _ in range(5):
        wholes = [read.trunk.loaded(0.0, 0.0), own.trunk.loaded(0.0, 0.0)]
        for a, b in zip(read.legs, own.legs, strict=True):
            angles = random.uniform(-0.7, 0.7, 3)
            legs = placed(a, angles), placed(b, angles)
            np.testing.assert_allclose(legs[0][1], legs[1][1], rtol=0.0, atol=1e-9)
            wholes = [together(whole, leg[0]) for whole, leg in zip(wholes, legs, strict=True)]
        assert wholes[0].mass == pytest.approx(wholes[1].mass, rel=1e-9)
        np.testing.assert_allclose(wholes[0].com, wholes[1].com, rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(wholes[0].inertia, wholes[1].inertia, rtol=0.0, atol=1e-9)


def assert_same(found: ImportedRobot, own: RobotDescription) -> None:
    read = found.robot
    assert_moves_alike(read, own)
    np.testing.assert_allclose(read.foot_radii, own.foot_radii, rtol=1e-9)
    for a, b in zip(read.legs, own.legs, strict=True):
        moving = {JOINTS[link.angle]: link.angle for link in links_of(b) if not link.locked}
        for joint, k in moving.items():
            np.testing.assert_allclose(a.stops[k], b.stops[k], rtol=1e-9, atol=1e-9)
            servos = read.servo_of(a, joint), own.servo_of(b, joint)
            for key in SERVO:
                values = [getattr(servo, key) for servo in servos]
                assert values[0] == pytest.approx(values[1], rel=1e-9), key
        mapped = {each.joint: each for each in read.joint_map if each.leg == a.name}
        assert set(mapped) == set(moving)
        for link in links_of(b):
            if not link.locked:
                each = mapped[JOINTS[link.angle]]
                assert each.name == f"{b.name}_{link.joint}"
                assert each.sign == 1
                assert each.offset == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_legs_of_every_kind_come_back_from_urdf(name: str, tmp_path: Path) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(robot_urdf(ROBOTS[name]))
    assert_same(import_robot(path, "zero"), ROBOTS[name])


@pytest.mark.parametrize("name", ROBOTS)
def test_legs_of_every_kind_come_back_from_mjcf(name: str, tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    from mujoco_models.tree import export_mjcf  # noqa: PLC0415  # an extra

    path = tmp_path / "robot.xml"
    path.write_text(export_mjcf(ROBOTS[name]))
    assert_same(import_robot(path, "stand"), ROBOTS[name])


def flat(lower: float = -3.2, upper: float = 3.2, height: float = 0.0) -> str:
    """A hexapod whose legs stick straight out where all joints are at 0, front legs forward.

    Args:
        lower, upper: range of femurs and tibias [rad].
        height: of the middle coxae over the others [m].
    """
    lines = ['<robot name="spider">', _link("trunk", 1.0)]
    for name, x, side, ahead in (
        ("a", 0.1, -1, 0.7), ("b", 0.0, -1, 0.0), ("c", -0.1, -1, -0.7),
        ("d", 0.1, 1, 0.7), ("e", 0.0, 1, 0.0), ("f", -0.1, 1, -0.7),
    ):  # fmt: skip
        yaw = side * (math.pi / 2.0 - ahead)
        z = height if ahead == 0.0 else 0.0
        # the axis of the coxa points up, those of femur and tibia to the left of the leg
        for child, parent, place, axis in (
            ("coxa", "trunk", f'xyz="{x} {0.06 * side} {z}" rpy="0 0 {yaw}"', "0 0 1"),
            ("femur", f"{name}_coxa", 'xyz="0.03 0 0"', "0 1 0"),
            ("tibia", f"{name}_femur", 'xyz="0.06 0 0"', "0 1 0"),
        ):
            low, high = (-1.0, 1.0) if child == "coxa" else (lower, upper)
            lines += [
                _link(f"{name}_{child}", 0.03, FOOT if child == "tibia" else ""),
                f'<joint name="{name}_{child}_joint" type="revolute"><parent link="{parent}"/>'
                f'<child link="{name}_{child}"/><origin {place}/><axis xyz="{axis}"/>'
                f'<limit lower="{low}" upper="{high}" effort="3" velocity="8"/></joint>',
            ]
    return "\n".join([*lines, "</robot>"])


FOOT = '<collision><origin xyz="0.1 0 0"/><geometry><sphere radius="0.008"/></geometry></collision>'


def _link(name: str, mass: float, inside: str = "") -> str:
    inertia = mass * 3e-4
    return (
        f'<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="{inertia}" ixy="0" '
        f'ixz="0" iyy="{inertia}" iyz="0" izz="{inertia}"/></inertial>{inside}</link>'
    )


def spider(folder: Path, text: str) -> ImportedRobot:
    path = folder / "spider.urdf"
    path.write_text(text)
    return import_robot(path)


@pytest.mark.parametrize("height", [0.0, 0.01])
def test_legs_that_stick_straight_out_are_bent_and_their_feet_levelled(
    height: float, tmp_path: Path
) -> None:
    found = spider(tmp_path, flat(height=height))
    robot = found.robot
    assert [leg.name for leg in robot.legs] == ["RF", "RM", "RH", "LF", "LM", "LH"]
    assert [leg.names[0][0] for leg in found.legs] == list("abcdef")
    feet = np.array([placed(leg, np.zeros(3))[1] for leg in robot.legs])
    assert np.ptp(feet[:, 2]) < 1e-12
    assert feet[:, 2].max() < -0.05
    for leg, ahead in zip(robot.legs, (0.7, 0.0, -0.7) * 2, strict=True):
        assert leg.pointing == pytest.approx(ahead)
        assert math.degrees(leg.femur_angle) == pytest.approx(110.0, abs=10.0)
        assert math.degrees(leg.femur_angle - leg.tibia_angle) == pytest.approx(5.0)
        assert leg.stops[1] == pytest.approx((-1.0, 1.0))
    told = "\n".join(found.dropped)
    assert "all joints at 0: the feet are not level" in told


def test_ranges_bend_the_legs_less(tmp_path: Path) -> None:
    found = spider(tmp_path, flat(-1.2, 1.2))
    for leg in found.robot.legs:
        low, high = leg.stops[0]
        assert low < 0.0 < high
        assert leg.tibia_angle <= 1.2 + 1e-9
    with pytest.raises(ModelFileError, match=r"the gait would move \w_femur_joint from .* its"):
        spider(tmp_path, flat(-0.01, 0.01))


def test_a_coxa_swings_the_foot_forward_and_a_femur_lifts_it(tmp_path: Path) -> None:
    robot = spider(tmp_path, flat()).robot
    for leg in robot.legs:
        rest = placed(leg, np.zeros(3))[1]
        aside, swung, lifted = (placed(leg, 0.1 * np.eye(3)[k])[1] - rest for k in range(3))
        assert aside[1] > 0.0
        assert swung[0] > 0.0
        assert lifted[2] > 0.0


def test_some_coxae_need_a_pose_by_name(tmp_path: Path) -> None:
    mixed = insect()
    legs = tuple(
        replace(leg, chain=CHAINS[0], femur_angle=0.2, tibia_angle=0.6) if k % 3 == 2 else leg
        for k, leg in enumerate(mixed.legs)
    )
    mixed = replace(mixed, legs=legs)
    path = tmp_path / "robot.urdf"
    path.write_text(robot_urdf(mixed))
    with pytest.raises(ModelFileError, match="4 of 6 legs have a coxa; allowed: all or none, or a"):
        import_robot(path)
    assert_same(import_robot(path, "zero"), mixed)


def test_a_leg_beside_its_abduction_behind_the_hip_is_refused(tmp_path: Path) -> None:
    path, text = tmp_path / "robot.urdf", robot_urdf(chained(CHAINS[1]))
    foot = re.search(r'<origin xyz="(0\.0) 0\.0 -\S+" />\s*<geometry>\s*<sphere', text)
    assert foot is not None
    path.write_text(text.replace(foot[0], foot[0].replace("0.0 0.0", "0.0 0.01", 1)))
    with pytest.raises(ModelFileError, match=r"its foot lies 0\.01 m beside the abduction"):
        import_robot(path, "zero")


@pytest.mark.parametrize("chain", [CHAINS[1], CHAINS[2]])
def test_the_rule_sets_the_feet_of_legs_without_a_coxa(
    chain: tuple[str, ...], tmp_path: Path
) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(robot_urdf(chained(chain)))
    found = import_robot(path)
    feet = np.array([placed(leg, np.zeros(3))[1] for leg in found.robot.legs])
    hips = np.mean([leg.hip_joint for leg in found.legs], axis=0)
    half = abs(found.legs[0].hip_joint[0] - found.legs[1].hip_joint[0]) / 2.0
    assert hips[2] - feet[:, 2] == pytest.approx(1.05 * half, rel=1e-9)
    com = NO_BODY
    for leg in found.robot.legs:
        com = together(com, placed(leg, np.zeros(3))[0])
    com = together(found.robot.trunk.loaded(0.0, 0.0), com)
    assert com.com[0] - feet[:, 0].mean() == pytest.approx(0.25 * half, rel=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_that_was_read_walks_as_its_original(name: str, tmp_path: Path) -> None:
    own, path = ROBOTS[name], tmp_path / "robot.urdf"
    path.write_text(robot_urdf(own))
    read = import_robot(path, "zero").robot
    # what a URDF does not say
    read = replace(
        read, contact=own.contact, sensor=own.sensor, controller=own.controller, rate=own.rate,
        trunk=replace(read.trunk, com_side_offset=0.0),
    )  # fmt: skip
    own = replace(own, trunk=replace(own.trunk, com_side_offset=0.0))
    servo = replace(read.servo, latency=own.servo.latency, slew_rate=own.servo.slew_rate)
    read = replace(read, servo=servo)
    walks = [
        apnc.simulate(apnc.Experiment(robot=robot, engine="compiled", duration=3.0, mi=0.12))
        for robot in (read, own)
    ]
    assert walks[0].complete
    for key in ("position", "foot_position"):
        found, expected = (walk.signals[key] for walk in walks)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-7)
    assert np.ptp(walks[1].signals["position"][:, 0]) > 0.02
