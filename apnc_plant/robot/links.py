"""The links of a leg as parts of a tree of joints, for engines and robot formats."""

from __future__ import annotations

from math import cos, isfinite, pi, sin
from typing import Final, NamedTuple

from apnc_plant.robot.body import MassProperties
from apnc_plant.robot.model import Leg
from apnc_plant.robot.quantities import Vector3

JOINT_RANGE: Final = (-pi, pi)
"""Range of a joint without stops [rad] for formats that need one: a full turn."""


LOCKED: Final = 1e15
"""Rotor inertia [kg m^2] that keeps a locked joint still in engines that cannot lock one."""


class Link(NamedTuple):
    """A link and the joint that moves it; its frame sits at the joint.

    Args:
        name: ``"hip_link"``, ``"femur_link"`` or ``"tibia_link"``.
        joint: name of the joint in the leg's ``chain``.
        position: of the joint, in the frame of the parent link or the trunk [m].
        axis: axis of the joint; coordinates of the tree turn about it.
        turn: rotation about the axis from the parent's frame to the link's in the reference pose
            [rad].
        sign: coordinate of the tree per joint angle of ``apnc_plant.signals``, 1 or -1.
        angle: which of ``apnc_plant.signals.JOINTS`` it is in commands and records.
        locked: True: the leg lacks this joint.
        body: mass properties in the frame of the link.
    """

    name: str
    joint: str
    position: Vector3
    axis: Vector3
    turn: float
    sign: float
    angle: int
    locked: bool
    body: MassProperties

    @property
    def positive(self) -> Vector3:
        """The axis about which positive joint angles of ``apnc_plant.signals`` turn."""
        x, y, z = self.axis
        return (self.sign * x, self.sign * y, self.sign * z)


def links_of(leg: Leg) -> tuple[Link, Link, Link]:
    """The links of a leg from the trunk outward; the foot is ``tibia_length`` below the last.

    A leg of two joints has three links too, one of them with a joint that is locked.
    """
    x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    side, flexes = leg.side, 1.0 if leg.knee == ">" else -1.0
    if leg.has_coxa:
        across = (side * cos(leg.pointing), -sin(leg.pointing), 0.0)
        joints = [
            ("coxa", z, 0.0, -side, 1),
            ("femur", across, leg.femur_angle, 1.0, 2),
            ("tibia", across, -leg.tibia_angle, side, 0),
        ]
    else:
        joints = [
            ("abduction", x, side * leg.abduction_angle, 1.0, 0),
            ("hip", y, leg.femur_angle, -1.0, 1),
            ("knee", y, -leg.tibia_angle, flexes, 2),
        ]
        if leg.chain[:2] == ("hip", "abduction"):
            joints[:2] = joints[1], joints[0]
    places = (leg.mount, leg.outward(leg.hip_offset), (0.0, 0.0, -leg.femur_length))
    names = ("hip_link", "femur_link", "tibia_link")
    bodies = (leg.mass_properties(link) for link in (leg.hip, leg.femur, leg.tibia))
    first, second, third = (
        Link(name, joint[0], place, *joint[1:], joint[0] not in leg.chain, body)
        for name, joint, place, body in zip(names, joints, places, bodies, strict=True)
    )
    return first, second, third


def range_of(stops: tuple[float, float]) -> tuple[float, float]:
    """Range of a joint for formats that need one [rad], with ``JOINT_RANGE`` for missing stops."""
    low, high = (
        stop if isfinite(stop) else full for stop, full in zip(stops, JOINT_RANGE, strict=True)
    )
    return low, high
