"""Servos and joints: of the robot, of one joint of every leg, and of one joint of one leg."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import field, fields, replace
from typing import Annotated, Any, Final

from apnc_plant.files import Number, checked, limits
from apnc_plant.robot.quantities import RobotDescriptionError

STOP_GIVE: Final = math.radians(1.0)
"""Angle by which the stall torque presses a joint into its stop [rad], if nothing else is said."""

Stiffness = Annotated[Number, limits("N m/rad", gt=0.0)]
Damping = Annotated[Number, limits("N m s/rad", ge=0.0)]
Torque = Annotated[Number, limits("N m", gt=0.0)]
Friction = Annotated[Number, limits("N m", ge=0.0)]
Speed = Annotated[Number, limits("rad/s", gt=0.0)]
RotorInertia = Annotated[Number, limits("kg m^2", ge=0.0)]


@checked(RobotDescriptionError)
class JointServo:
    """What the servo of a joint has of its own; None: as the servo that it differs from.

    Args:
        stiffness, damping, stall_torque, no_load_speed, reflected_inertia: as in :class:`Servo`.
        joint_damping, dry_friction, friction_speed, stop_stiffness, stop_damping: likewise.
    """

    stiffness: Stiffness | None = None
    damping: Damping | None = None
    stall_torque: Torque | None = None
    no_load_speed: Speed | None = None
    reflected_inertia: RotorInertia | None = None
    joint_damping: Damping | None = None
    dry_friction: Friction | None = None
    friction_speed: Speed | None = None
    stop_stiffness: Stiffness | None = None
    stop_damping: Damping | None = None


NOTHING_OWN: Final = JointServo()
"""The servo of a joint that has nothing of its own."""


@checked(RobotDescriptionError)
class LegServos:
    """What the servos of a leg have of their own.

    Args:
        abduction, hip, knee: of these joints.
    """

    abduction: JointServo = field(default_factory=JointServo)
    hip: JointServo = field(default_factory=JointServo)
    knee: JointServo = field(default_factory=JointServo)


@checked(RobotDescriptionError)
class Servo:
    """A geared position servo and the joint that it turns.

    Args:
        stiffness: torque per position error [N m/rad].
        damping: torque per joint speed [N m s/rad].
        stall_torque: largest torque [N m].
        no_load_speed: speed at which no driving torque is left [rad/s].
        reflected_inertia: rotor inertia times the gear ratio squared [kg m^2].
        latency: age of a command when the servo starts to follow it [s].
        slew_rate: fastest change of the command that the servo follows [rad/s]; 0 for no limit.
        joint_damping: damping of the joint itself, which no torque limit bounds [N m s/rad].
        dry_friction: Coulomb friction of the joint itself [N m].
        friction_speed: below this speed dry friction is proportional to it [rad/s].
        stop_stiffness: torque per angle beyond a stop of the joint [N m/rad]; None for the stall
            torque at ``STOP_GIVE``.
        stop_damping: torque per speed there [N m s/rad]; None for ``damping``.
        abduction, hip, knee: what the servos of these joints have of their own, in all legs.
    """

    stiffness: Stiffness
    damping: Damping
    stall_torque: Torque
    no_load_speed: Speed
    reflected_inertia: RotorInertia = 0.0
    latency: Annotated[Number, limits("s", ge=0.0)] = 0.0
    slew_rate: Annotated[Number, limits("rad/s", ge=0.0)] = 0.0
    joint_damping: Damping = 0.0
    dry_friction: Friction = 0.0
    friction_speed: Speed = 0.1
    stop_stiffness: Stiffness | None = None
    stop_damping: Damping | None = None
    abduction: JointServo = field(default_factory=JointServo)
    hip: JointServo = field(default_factory=JointServo)
    knee: JointServo = field(default_factory=JointServo)

    @property
    def stop(self) -> tuple[float, float]:
        """Stiffness [N m/rad] and damping [N m s/rad] of the stops."""
        stiffness, damping = self.stop_stiffness, self.stop_damping
        return (
            self.stall_torque / STOP_GIVE if stiffness is None else stiffness,
            self.damping if damping is None else damping,
        )

    def of_joint(self, joint: str, leg: LegServos) -> Servo:
        """The servo of a joint: what the leg says of it, else this servo's joint, else this servo.

        Args:
            joint: ``abduction``, ``hip`` or ``knee``.
            leg: what the servos of its leg have of their own.
        """
        own = self.own_of_joint(joint, leg)
        if not own and self.abduction == self.hip == self.knee == NOTHING_OWN:
            return self
        return replace(self, **own, abduction=NOTHING_OWN, hip=NOTHING_OWN, knee=NOTHING_OWN)

    def own_of_joint(self, joint: str, leg: LegServos) -> dict[str, float]:
        """What the servo of a joint has of its own, by key; arguments as of :meth:`of_joint`."""
        servos = getattr(self, joint), getattr(leg, joint)
        return {} if servos == (NOTHING_OWN, NOTHING_OWN) else _said(servos)


def _said(servos: Iterable[JointServo]) -> dict[str, Any]:
    """What is said of a servo; what comes later goes before."""
    found = {}
    for servo in servos:
        for each in fields(servo):
            value = getattr(servo, each.name)
            if value is not None:
                found[each.name] = value
    return found
