"""The links of a leg as parts of a tree of joints, for engines and robot formats."""

from __future__ import annotations

from math import pi
from typing import Final, NamedTuple

from apnc_plant.robot.model import Leg, MassProperties, Vector3

JOINT_RANGE: Final = (-pi, pi)
"""Range of every joint [rad] for formats that need one. It is a full turn: joints have no stops."""


class Link(NamedTuple):
    """A link and the joint that moves it; its frame sits at the joint.

    Args:
        name: ``"hip_link"``, ``"femur_link"`` or ``"tibia_link"``.
        joint: ``"abduction"``, ``"hip"`` or ``"knee"``.
        position: of the joint, in the frame of the parent link or the trunk [m].
        pitch: rotation about y from the parent's frame to the link's in the reference pose [rad].
        axis: axis of the joint; positive angles are those of ``apnc_plant.signals``.
        body: mass properties in the frame of the link.
    """

    name: str
    joint: str
    position: Vector3
    pitch: float
    axis: Vector3
    body: MassProperties


def links_of(leg: Leg) -> tuple[Link, Link, Link]:
    """The links of a leg from the trunk outward; the foot is ``tibia_length`` below the last."""
    forward, down = (0.0, -1.0, 0.0), (0.0, 0.0, -leg.femur_length)
    hip, femur, tibia = (leg.mass_properties(link) for link in (leg.hip, leg.femur, leg.tibia))
    return (
        Link("hip_link", "abduction", leg.mount, 0.0, (1.0, 0.0, 0.0), hip),
        Link("femur_link", "hip", leg.outward(leg.hip_offset), leg.femur_angle, forward, femur),
        Link("tibia_link", "knee", down, -leg.tibia_angle, forward, tibia),
    )
