"""What a file does not say is the reference robot's, scaled: robots of all sizes move alike."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from apnc import importing
from apnc.importing import ImportedRobot, import_robot
from apnc_plant.robot import Body, Leg, RobotDescription, load_robot
from apnc_plant.robot.urdf import robot_urdf

LONGER, HEAVIER = 3.0, 11.0
REFERENCE = load_robot(Path(importing.__file__).with_name("reference.toml"))


def larger(robot: RobotDescription) -> RobotDescription:
    """The robot with all lengths and all masses times the same factors."""

    def body(own: Body) -> Body:
        return replace(
            own,
            mass=own.mass * HEAVIER,
            size=tuple(edge * LONGER for edge in own.size),
            com=tuple(x * LONGER for x in own.com),
        )

    def leg(own: Leg) -> Leg:
        return replace(
            own,
            mount=tuple(x * LONGER for x in own.mount),
            hip_offset=tuple(x * LONGER for x in own.hip_offset),
            femur_length=own.femur_length * LONGER,
            tibia_length=own.tibia_length * LONGER,
            hip=body(own.hip),
            femur=body(own.femur),
            tibia=body(own.tibia),
        )

    return replace(robot, trunk=body(robot.trunk), legs=tuple(map(leg, robot.legs)))


def bare(robot: RobotDescription, folder: Path) -> ImportedRobot:
    """The robot from a URDF that says nothing of its joints' drives."""
    text = re.sub(r"<!--.*?-->", "", robot_urdf(robot), flags=re.DOTALL)
    text = re.sub(r'(effort|velocity)="[^"]*"', r'\1="0"', text)
    path = folder / "robot.urdf"
    path.write_text(text)
    return import_robot(path)


def test_the_reference_robot_without_drives_gets_its_own(tmp_path: Path) -> None:
    own = REFERENCE
    found = bare(own, tmp_path)
    for name, value in vars(found.robot.servo).items():
        assert value == pytest.approx(getattr(own.servo, name)), name
    for name, value in vars(found.robot.contact).items():
        assert value == pytest.approx(getattr(own.contact, name)), name
    assert found.robot.sensor.delay == pytest.approx(own.sensor.delay)
    assert found.robot.trunk.com_side_offset == pytest.approx(own.trunk.com_side_offset)
    assert found.robot.rate == pytest.approx(60.0)
    # it walks about the pose of the file
    assert found.robot.controller == {**own.controller, "b1": 0.0, "b2": 0.0}


def test_a_larger_robot_moves_alike(tmp_path: Path) -> None:
    """Forces over weight and times over the root of length are those of the reference robot."""
    own = REFERENCE
    found = bare(larger(own), tmp_path)
    force, torque, time = HEAVIER, HEAVIER * LONGER, LONGER**0.5
    servo, contact = found.robot.servo, found.robot.contact
    for value, original, factor in (
        (found.robot.mass, own.mass, HEAVIER),
        (servo.stall_torque, own.servo.stall_torque, torque),
        (servo.stiffness, own.servo.stiffness, torque),
        # a drive's own lag does not grow with the robot
        (servo.damping / servo.stiffness, own.servo.damping / own.servo.stiffness, 1.0),
        (servo.no_load_speed, own.servo.no_load_speed, 1.0 / time),
        (servo.reflected_inertia, own.servo.reflected_inertia, torque * time**2),
        (contact.stiffness, own.contact.stiffness, force / LONGER),
        (contact.damping, own.contact.damping, force / (LONGER / time)),
        (contact.damping_depth, own.contact.damping_depth, LONGER),
        (contact.friction_speed, own.contact.friction_speed, LONGER / time),
        (found.robot.sensor.delay, own.sensor.delay, time),
        (found.robot.sensor.time_constant, own.sensor.time_constant, time),
        (found.robot.rate, 60.0, 1.0 / time),
    ):
        assert value == pytest.approx(original * factor)


def with_effort(effort: str, folder: Path) -> ImportedRobot:
    """The reference robot with another torque limit, from a URDF that says no more."""
    text = re.sub(r"<!--.*?-->", "", robot_urdf(REFERENCE), flags=re.DOTALL)
    path = folder / "robot.urdf"
    path.write_text(re.sub(r'effort="[^"]*"', f'effort="{effort}"', text))
    return import_robot(path)


def test_a_weaker_motor_is_lighter_and_softer(tmp_path: Path) -> None:
    own = REFERENCE
    found = with_effort(repr(own.servo.stall_torque / 4.0), tmp_path)
    servo, contact = found.robot.servo, found.robot.contact
    assert servo.reflected_inertia == pytest.approx(own.servo.reflected_inertia / 4.0)
    assert servo.stiffness == pytest.approx(own.servo.stiffness * 0.625)
    assert servo.damping == pytest.approx(own.servo.damping * 0.625)
    # nearly all of the mass of a foot is that of the rotor, so damping falls with the root of it
    assert 0.5 < contact.damping / own.contact.damping < 0.53
    assert contact.stiffness == pytest.approx(own.contact.stiffness)


def test_a_stronger_motor_is_as_the_references(tmp_path: Path) -> None:
    own = REFERENCE.servo
    servo = with_effort(repr(own.stall_torque * 2.0), tmp_path).robot.servo
    assert servo.stall_torque == pytest.approx(own.stall_torque * 2.0)
    assert servo.reflected_inertia == pytest.approx(own.reflected_inertia)
    assert servo.stiffness == pytest.approx(own.stiffness)


@pytest.mark.parametrize(("share", "kept"), [(0.26, True), (0.24, False)])
def test_a_rotor_too_light_for_its_torque_is_a_placeholder(
    share: float, kept: bool, tmp_path: Path
) -> None:
    own = REFERENCE
    light = replace(own.servo, reflected_inertia=share * own.servo.reflected_inertia)
    path = tmp_path / "robot.urdf"
    path.write_text(robot_urdf(replace(own, servo=light)))
    found = import_robot(path)
    rotor = light.reflected_inertia if kept else own.servo.reflected_inertia
    assert found.robot.servo.reflected_inertia == pytest.approx(rotor)
    told = [line for line in found.dropped if line.startswith("armature 0.0023")]
    assert len(told) == (0 if kept else 1)


def test_more_legs_bear_less_each(tmp_path: Path) -> None:
    found = bare(load_robot("octopod"), tmp_path)
    assert [leg.name for leg in found.robot.legs] == [
        "RF",
        "R2",
        "R3",
        "RH",
        "LF",
        "L2",
        "L3",
        "LH",
    ]
    four, gains = bare(REFERENCE, tmp_path), found.robot.controller
    assert "F_max" not in four.robot.controller
    assert gains["F_max"] == pytest.approx(0.5)
    assert gains["alpha"] == pytest.approx(0.45)
