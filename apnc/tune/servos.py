"""Servos of a robot with other gains or rotors, those of single joints included."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from apnc_plant.robot import RobotDescription
from apnc_plant.robot.servo import JointServo, LegServos, Servo

_JOINTS = ("abduction", "hip", "knee")

Change = Callable[[JointServo, JointServo], JointServo]
"""What a joint has of its own, made of that and of what the same joint of all legs has."""


def geared(robot: RobotDescription, share: float, lag: float) -> RobotDescription:
    """The robot with other gains of its servos.

    Args:
        robot: the robot.
        share: stiffness of every servo, as a share of what it is [1].
        lag: damping of every servo over its stiffness [s].
    """
    common = robot.servo.stiffness * share

    def changed(own: JointServo, of_all: JointServo) -> JointServo:
        if own.stiffness is None and own.damping is None:
            return own
        stiffness = None if own.stiffness is None else own.stiffness * share
        inherited = common if of_all.stiffness is None else of_all.stiffness * share
        return replace(own, stiffness=stiffness, damping=lag * (stiffness or inherited))

    return _with(robot, replace(robot.servo, stiffness=common, damping=lag * common), changed)


def with_rotors(robot: RobotDescription, share: float) -> RobotDescription:
    """The robot with other rotors.

    Args:
        robot: the robot.
        share: reflected inertia of every servo, as a share of what it is [1].
    """

    def changed(own: JointServo, _: JointServo) -> JointServo:
        if own.reflected_inertia is None:
            return own
        return replace(own, reflected_inertia=own.reflected_inertia * share)

    rotor = robot.servo.reflected_inertia * share
    return _with(robot, replace(robot.servo, reflected_inertia=rotor), changed)


def _with(robot: RobotDescription, servo: Servo, changed: Change) -> RobotDescription:
    of_all = {joint: getattr(robot.servo, joint) for joint in _JOINTS}
    own = {joint: changed(each, JointServo()) for joint, each in of_all.items()}
    servo = replace(servo, abduction=own["abduction"], hip=own["hip"], knee=own["knee"])
    legs = tuple(
        leg
        if leg.servo == LegServos()
        else replace(
            leg,
            servo=replace(
                leg.servo, **{j: changed(getattr(leg.servo, j), of_all[j]) for j in _JOINTS}
            ),
        )
        for leg in robot.legs
    )
    return replace(robot, servo=servo, legs=legs)
