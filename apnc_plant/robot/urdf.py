"""Robots as URDF text, the format of ROS."""

from __future__ import annotations

from collections.abc import Iterable
from math import asin, atan2, cos, sin
from typing import Any, Final
from xml.etree import ElementTree

import numpy as np

from apnc_plant.robot.body import MassProperties
from apnc_plant.robot.links import Link, links_of, range_of
from apnc_plant.robot.model import Leg, RobotDescription
from apnc_plant.robot.names import plainly_named
from apnc_plant.robot.servo import Servo
from apnc_plant.signals import JOINTS

ROOTS: Final = ("trunk", "base")
"""Names that the root link may have, see :func:`robot_urdf`."""

Element = ElementTree.Element
_add = ElementTree.SubElement

_INERTIA: Final = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_NOTHING: Final = MassProperties(0.0, np.zeros(3), np.zeros((3, 3)))


def robot_urdf(robot: RobotDescription, *, root: str = "trunk") -> str:
    """A robot as URDF, its joints with our signs and reference pose.

    Joints are ``revolute`` between their stops, or with ``JOINT_RANGE``. ``effort`` is the stall
    torque, ``velocity`` the no-load speed. URDF has no element for the line between them, for rotor
    inertia and for contact stiffness; a comment gives stiffness, damping and rotor inertia of the
    servo, one in a joint those of its own. The collision
    shapes are boxes for trunk, hip and femur links and a ball at each tibia for the foot. A link of
    zero mass marks the centre of the ball; it has an inertial, because some loaders count a link
    without one as 1 kg.

    Args:
        robot: the robot; its names become plain ones, see ``plain_name``.
        root: ``trunk``; or ``base``, a link without mass to which the joint ``floating_base``
            fixes the trunk. ROS needs ``base``, since KDL ignores the inertia of a root link.

    Raises:
        ValueError: the root is unknown.

    Pitfall: PyBullet makes a ``base`` without inertial 1 kg heavy, and holds one of zero mass in
    the air.
    """
    if root not in ROOTS:
        raise ValueError(f"root '{root}' is not one of {', '.join(ROOTS)}")
    robot = plainly_named(robot)
    model = Element("robot", name=robot.name)
    model.append(_comment(robot.servo))
    if root != "trunk":
        _add(model, "link", name=root)
        _joint(model, "floating_base", "fixed", root, "trunk")
    trunk = robot.trunk
    _box(_link(model, "trunk", trunk.loaded(0.0, 0.0)), trunk.center, trunk.edges, _TOUCHING)
    for leg in robot.legs:
        _leg(model, leg, robot)
    ElementTree.indent(model)
    return ElementTree.tostring(model, encoding="unicode", xml_declaration=True) + "\n"


def _leg(root: Element, leg: Leg, robot: RobotDescription) -> None:
    parent, common = "trunk", _comment(robot.servo).text
    for link, box in zip(links_of(leg), (leg.hip, leg.femur, leg.tibia), strict=True):
        servo, stops = robot.servo_of(leg, JOINTS[link.angle]), leg.stops[link.angle]
        limits = dict(zip(("lower", "upper"), map(repr, range_of(stops)), strict=True))
        limits |= {"effort": repr(servo.stall_torque), "velocity": repr(servo.no_load_speed)}
        name = f"{leg.name}_{link.name}"
        element = _link(root, name, link.body)
        touch = _SEEN if box is leg.tibia else _TOUCHING
        _box(element, leg.outward(box.com), box.size, touch, leg.yaw)
        kind = "fixed" if link.locked else "revolute"
        joint = _joint(root, f"{leg.name}_{link.joint}", kind, parent, name)
        _add(
            joint,
            "origin",
            xyz=_numbers(link.position),
            rpy=_numbers(_rpy(link)),
        )
        parent = name
        if link.locked:
            continue
        _add(joint, "axis", xyz=_numbers(link.positive))
        _add(joint, "limit", limits)
        if servo.joint_damping or servo.dry_friction:
            passive = {"damping": servo.joint_damping, "friction": servo.dry_friction}
            _add(joint, "dynamics", {key: repr(value) for key, value in passive.items()})
        if (comment := _comment(servo)).text != common:
            joint.append(comment)
    foot = (0.0, 0.0, -leg.tibia_length)
    for kind in _TOUCHING:
        shape = _add(element, kind)
        _add(shape, "origin", xyz=_numbers(foot))
        _add(_add(shape, "geometry"), "sphere", radius=repr(robot.foot_radius_of(leg)))
    _link(root, f"{leg.name}_foot", _NOTHING)
    fixed = _joint(root, f"{leg.name}_foot_joint", "fixed", parent, f"{leg.name}_foot")
    _add(fixed, "origin", xyz=_numbers(foot))


def _comment(servo: Servo) -> Any:
    """What URDF has no element for."""
    return ElementTree.Comment(
        f" servo: stiffness {servo.stiffness!r} N m/rad, damping {servo.damping!r} N m s/rad, "
        f"reflected rotor inertia {servo.reflected_inertia!r} kg m^2 "
    )


def _joint(root: Element, name: str, kind: str, parent: str, child: str) -> Element:
    joint = _add(root, "joint", name=name, type=kind)
    _add(joint, "parent", link=parent)
    _add(joint, "child", link=child)
    return joint


def _link(root: Element, name: str, body: MassProperties) -> Element:
    link = _add(root, "link", name=name)
    inertial = _add(link, "inertial")
    _add(inertial, "origin", xyz=_numbers(body.com))
    _add(inertial, "mass", value=repr(float(body.mass)))
    entries = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
    values = (repr(float(body.inertia[entry])) for entry in entries)
    _add(inertial, "inertia", dict(zip(_INERTIA, values, strict=True)))
    return link


_SEEN: Final = ("visual",)
_TOUCHING: Final = ("visual", "collision")
"""Uses of a shape. The box of a tibia is only visible: its edges would touch beside the ball."""


def _box(
    link: Element,
    center: Iterable[float],
    size: Iterable[float],
    kinds: Iterable[str],
    yaw: float = 0.0,
) -> None:
    for kind in kinds:
        shape = _add(link, kind)
        origin = _add(shape, "origin", xyz=_numbers(center))
        if yaw != 0.0:
            origin.set("rpy", _numbers((0.0, 0.0, yaw)))
        _add(_add(shape, "geometry"), "box", size=_numbers(size))


def _rpy(link: Link) -> tuple[float, float, float]:
    """Roll, pitch and yaw of a link in its parent's frame in the reference pose [rad]."""
    x, y, z = link.axis
    if sorted(map(abs, link.axis)) == [0.0, 0.0, 1.0]:
        return (link.turn * x, link.turn * y, link.turn * z)
    c, s = cos(link.turn), sin(link.turn)  # a horizontal axis
    row = (-s * y, s * x, c)
    return (atan2(row[1], row[2]), -asin(row[0]), atan2((1 - c) * x * y, (1 - c) * x * x + c))


def _numbers(values: Iterable[float]) -> str:
    """Numbers with all digits, and without minus zero."""
    return " ".join(repr(float(value) + 0.0) for value in values)
