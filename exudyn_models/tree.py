"""The robot as one Exudyn kinematic tree in minimal coordinates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import cos, sin
from typing import Any, Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.coordinates import BASE
from apnc_plant.robot.body import MassProperties
from apnc_plant.robot.links import LOCKED, Link, links_of
from apnc_plant.robot.model import Leg, RobotDescription
from apnc_plant.robot.quantities import Vector3
from apnc_plant.signals import JOINTS
from exudyn_models.engine import exu, items

UPRIGHT: Final = np.eye(3)
MASSLESS: Final = MassProperties(0.0, np.zeros(3), np.zeros((3, 3)))

Forces = Callable[[Any, float, int, list[float], list[float]], list[float]]
"""(system, time [s], item, coordinates, speeds) -> generalized forces."""


@dataclass
class _Links:
    """Lists that describe the links of the tree, with one entry per coordinate.

    Attributes:
        rotors: reflected rotor inertia of the joints of the legs [kg m^2].
    """

    types: list[Any] = field(default_factory=list)
    parents: list[int] = field(default_factory=list)
    rotations: list[Array] = field(default_factory=list)
    offsets: list[Array] = field(default_factory=list)
    masses: list[float] = field(default_factory=list)
    inertias: list[Array] = field(default_factory=list)
    coms: list[Array] = field(default_factory=list)
    rotors: list[float] = field(default_factory=list)

    def add(
        self,
        joint: Any,
        parent: int,
        offset: Vector3 | Array = (0.0, 0.0, 0.0),
        rotation: Array = UPRIGHT,
        body: MassProperties = MASSLESS,
    ) -> int:
        self.types.append(joint)
        self.parents.append(parent)
        self.offsets.append(np.array(offset))
        self.rotations.append(rotation)
        self.masses.append(body.mass)
        self.inertias.append(body.inertia)
        self.coms.append(body.com)
        return len(self.parents) - 1


def add_tree(
    mbs: Any,
    robot: RobotDescription,
    trunk: MassProperties,
    gravity: float,
    start: Array,
    forces: Forces,
) -> Any:
    """Add trunk, legs and reflected rotor inertia to an Exudyn system; returns the tree's number.

    Args:
        mbs: the system.
        robot: the robot.
        trunk: mass properties of the trunk with the payload.
        gravity: downward acceleration [m/s^2].
        start: initial coordinates, shape (6 + 3 n_legs,), see ``coordinates``.
        forces: function that Exudyn calls for all generalized forces but gravity.
    """
    links = _Links()
    base = _add_base(links, trunk)
    for leg in robot.legs:
        _add_leg(links, leg, base, robot)
    size = len(links.parents)
    node = mbs.AddNode(
        items().NodeGenericODE2(
            referenceCoordinates=np.zeros(size),
            initialCoordinates=start,
            initialCoordinates_t=np.zeros(size),
            numberOfODE2Coordinates=size,
        )
    )
    tree = mbs.AddObject(_tree_object(links, node, gravity, forces))
    _add_reflected_inertia(mbs, node, links.rotors)
    return tree


def _add_base(links: _Links, trunk: MassProperties) -> int:
    kind = exu().JointType
    link = -1
    for joint in (kind.PrismaticX, kind.PrismaticY, kind.PrismaticZ, kind.RevoluteZ):
        link = links.add(joint, link)
    link = links.add(kind.RevoluteY, link)
    return links.add(kind.RevoluteX, link, body=trunk)


def _add_leg(links: _Links, leg: Leg, trunk: int, robot: RobotDescription) -> None:
    at, inner = trunk, UPRIGHT
    for link in links_of(leg):
        # Exudyn turns joints about x, y or z of a frame, so frames are yawed to oblique axes
        joint, frame = _joint_of(link)
        body = MassProperties(
            link.body.mass, frame.T @ link.body.com, frame.T @ link.body.inertia @ frame
        )
        turn = inner.T @ frame @ _turned(joint, link.turn)
        at = links.add(joint, at, inner.T @ link.position, turn, body)
        inner = frame
        rotor = robot.servo_of(leg, JOINTS[link.angle]).reflected_inertia
        links.rotors.append(LOCKED if link.locked else rotor)


def _tree_object(links: _Links, node: Any, gravity: float, forces: Forces) -> Any:
    return items().ObjectKinematicTree(
        nodeNumber=node,
        gravity=[0.0, 0.0, -gravity],
        jointTypes=links.types,
        linkParents=links.parents,
        jointTransformations=exu().Matrix3DList(links.rotations),
        jointOffsets=exu().Vector3DList(links.offsets),
        linkInertiasCOM=exu().Matrix3DList(links.inertias),
        linkCOMs=exu().Vector3DList(links.coms),
        linkMasses=links.masses,
        forceUserFunction=forces,
    )


def _add_reflected_inertia(mbs: Any, node: Any, rotors: list[float]) -> None:
    # The tree has no field for rotor inertia; a second object on the same node adds it to M.
    diagonal = np.concatenate([np.zeros(BASE), rotors])
    mbs.AddObject(items().ObjectGenericODE2(nodeNumbers=[node], massMatrix=np.diag(diagonal)))


def _joint_of(link: Link) -> tuple[Any, Array]:
    """Kind of a joint, and the rotation from the frame in which it has this kind to its link's."""
    kind, (x, y, z) = exu().JointType, link.axis
    if link.axis == (0.0, 1.0, 0.0):
        return kind.RevoluteY, UPRIGHT
    if z != 0.0:
        return kind.RevoluteZ, UPRIGHT
    return kind.RevoluteX, np.array([[x, -y, 0.0], [y, x, 0.0], [0.0, 0.0, 1.0]])


def _turned(joint: Any, angle: float) -> Array:
    """Rotation about the axis of a kind of joint.

    Rotation.from_rotvec rounds otherwise, which a walk shows after a few seconds.
    """
    kind, c, s = exu().JointType, cos(angle), sin(angle)
    if joint == kind.RevoluteX:
        return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    if joint == kind.RevoluteY:
        return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
