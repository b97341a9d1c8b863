"""A robot whose legs differ from each other, for whatever must not mix them up."""

from __future__ import annotations

from dataclasses import replace

from apnc_plant.robot import RobotDescription, load_robot


def odd_robot() -> RobotDescription:
    """Lilibot with another length, pose, mass and offset in every leg, and a shifted trunk.

    The knees of two legs lie in front, and all but one leg stand sprawled.
    """
    robot = load_robot("lilibot")
    legs = tuple(
        replace(
            leg,
            hip_offset=(0.01 * k, 0.007 * k, -0.03 - 0.002 * k),
            femur_length=0.07 + 0.005 * k,
            tibia_length=0.085 - 0.004 * k,
            femur_angle=(-1.0 if k % 2 else 1.0) * (leg.femur_angle + 0.1 * k),
            tibia_angle=(-1.0 if k % 2 else 1.0) * (leg.tibia_angle - 0.2 * k),
            knee=">" if k % 2 else "<",
            abduction_angle=0.07 * k,
            tibia=replace(leg.tibia, mass=0.085 + 0.01 * k, com=(0.003 * k, 0.002 * k, -0.04)),
        )
        for k, leg in enumerate(robot.legs)
    )
    trunk = replace(robot.trunk, com=(0.0149, 0.003, -0.0044))
    return replace(robot, name="odd", legs=legs, trunk=trunk)
