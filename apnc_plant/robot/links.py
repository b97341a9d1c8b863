"""The links of a leg as parts of a tree of joints, for engines and robot formats."""

from __future__ import annotations

from math import isfinite, pi
from typing import Final, NamedTuple

from apnc_plant.robot.body import MassProperties
from apnc_plant.robot.model import Leg
from apnc_plant.robot.quantities import Vector3

JOINT_RANGE: Final = (-pi, pi)
"""Range of a joint without stops [rad] for formats that need one: a full turn."""


class Link(NamedTuple):
    """A link and the joint that moves it; its frame sits at the joint.

    Args:
        name: ``"hip_link"``, ``"femur_link"`` or ``"tibia_link"``.
        joint: ``"abduction"``, ``"hip"`` or ``"knee"``.
        position: of the joint, in the frame of the parent link or the trunk [m].
        axis: axis of the joint; coordinates of the tree turn about it.
        turn: rotation about the axis from the parent's frame to the link's in the reference pose
            [rad].
        sign: coordinate of the tree per joint angle of ``apnc_plant.signals``, 1 or -1.
        body: mass properties in the frame of the link.
    """

    name: str
    joint: str
    position: Vector3
    axis: Vector3
    turn: float
    sign: float
    body: MassProperties

    @property
    def positive(self) -> Vector3:
        """The axis about which positive joint angles of ``apnc_plant.signals`` turn."""
        x, y, z = self.axis
        return (self.sign * x, self.sign * y, self.sign * z)


def links_of(leg: Leg) -> tuple[Link, Link, Link]:
    """The links of a leg from the trunk outward; the foot is ``tibia_length`` below the last."""
    x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    to_hip, to_knee = leg.outward(leg.hip_offset), (0.0, 0.0, -leg.femur_length)
    sprawl, flexes = leg.side * leg.abduction_angle, 1.0 if leg.knee == ">" else -1.0
    hip, femur, tibia = (leg.mass_properties(link) for link in (leg.hip, leg.femur, leg.tibia))
    return (
        Link("hip_link", "abduction", leg.mount, x, sprawl, 1.0, hip),
        Link("femur_link", "hip", to_hip, y, leg.femur_angle, -1.0, femur),
        Link("tibia_link", "knee", to_knee, y, -leg.tibia_angle, flexes, tibia),
    )


def range_of(stops: tuple[float, float]) -> tuple[float, float]:
    """Range of a joint for formats that need one [rad], with ``JOINT_RANGE`` for missing stops."""
    low, high = (
        stop if isfinite(stop) else full for stop, full in zip(stops, JOINT_RANGE, strict=True)
    )
    return low, high
