"""Robots that need a shorter integration step than the shipped ones."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

from apnc_plant.robot import Body, Leg, RobotDescription, load_robot
from apnc_plant.robot.model import CHAINS


def chained(chain: tuple[str, ...], name: str = "lilibot") -> RobotDescription:
    """A shipped robot with other joints in its legs, which stand a little apart from each other."""
    robot, pose = load_robot(name), {}
    if chain[0] == "coxa":
        pose = {"femur_angle": math.radians(110.0), "tibia_angle": math.radians(105.0)}
        pose |= {"hip_offset": (0.0, 0.03, 0.0)}
    legs = []
    for k, leg in enumerate(robot.legs):
        own = {"pointing": 0.2 - 0.1 * k} if chain[0] == "coxa" else {"abduction_angle": 0.05 * k}
        legs.append(replace(leg, chain=chain, **pose, **own))
    return replace(robot, name=f"{name} with {'-'.join(chain)}", legs=tuple(legs))


def x_pose() -> RobotDescription:
    """Lilibot with its hind knees in front, and all feet a little farther forward."""
    robot = load_robot("lilibot")

    def posed(leg: Leg) -> Leg:
        if leg.name in ("RF", "LF"):
            return replace(leg, femur_angle=leg.femur_angle - math.radians(18.0))
        femur = -leg.femur_angle - math.radians(12.0)
        return replace(leg, knee=">", femur_angle=femur, tibia_angle=-leg.tibia_angle)

    return replace(robot, name="x pose", legs=tuple(map(posed, robot.legs)))


def insect() -> RobotDescription:
    """A hexapod with a coxa, a femur and a tibia in every leg."""
    return load_robot(Path(__file__).with_name("insect.toml"))


def every_chain() -> RobotDescription:
    """A robot of six legs with joints of every chain, at about the same height."""
    robot, legs = load_robot("hexapod"), []
    for k, leg in enumerate(robot.legs):
        chain = (*CHAINS, CHAINS[3])[k]
        own: dict[str, object] = {"abduction_angle": 0.05 * k}
        if chain[0] == "coxa":
            own = {"pointing": 0.3 * (k - 4), "hip_offset": (0.0, 0.03, 0.0)}
            own |= {"femur_angle": math.radians(80.0), "tibia_angle": math.radians(70.0)}
        legs.append(replace(leg, chain=chain, **own))
    return replace(robot, name="every chain", legs=tuple(legs))


def stiff_kneed() -> RobotDescription:
    """Lilibot with light tibias, small rotors and stiff servos; it falls at 1/960 s."""
    robot = load_robot("lilibot")
    legs = tuple(replace(leg, tibia=replace(leg.tibia, mass=0.03)) for leg in robot.legs)
    servo = replace(
        robot.servo, stiffness=40.0, damping=3.0, stall_torque=8.0, no_load_speed=20.0,
        reflected_inertia=0.0003,
    )  # fmt: skip
    return replace(robot, name="stiff-kneed", legs=legs, servo=servo)


def heavy(mass: float = 50.0) -> RobotDescription:
    """Lilibot scaled to a mass [kg] at equal density and equal Froude number, with hard feet."""
    robot = load_robot("lilibot")
    m = mass / robot.mass
    L = m ** (1.0 / 3.0)
    time = math.sqrt(L)

    def body(of: Body) -> Body:
        size, com = (tuple(L * x for x in each) for each in (of.size, of.com))
        return replace(of, mass=m * of.mass, size=size, com=com)

    def leg(of: Leg) -> Leg:
        mount, hip_offset = (tuple(L * x for x in each) for each in (of.mount, of.hip_offset))
        links = {name: body(getattr(of, name)) for name in ("hip", "femur", "tibia")}
        lengths = {name: L * getattr(of, name) for name in ("femur_length", "tibia_length")}
        return replace(of, mount=mount, hip_offset=hip_offset, **links, **lengths)

    trunk = replace(
        body(robot.trunk),
        center=tuple(L * x for x in robot.trunk.center),
        com_side_offset=L * robot.trunk.com_side_offset,
    )
    servo = replace(
        robot.servo,
        stiffness=m * L * robot.servo.stiffness,
        damping=m * L * time * robot.servo.damping,
        stall_torque=m * L * robot.servo.stall_torque,
        no_load_speed=robot.servo.no_load_speed / time,
        reflected_inertia=m * L**2 * robot.servo.reflected_inertia,
    )
    contact = replace(
        robot.contact,
        foot_radius=L * robot.contact.foot_radius,
        stiffness=4.0 * m / L * robot.contact.stiffness,
        damping=4.0 * m / time * robot.contact.damping,
    )
    return replace(
        robot, name="heavy", trunk=trunk, legs=tuple(map(leg, robot.legs)), servo=servo,
        contact=contact,
    )  # fmt: skip
