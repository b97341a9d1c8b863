"""Robots as URDF text, the format of ROS."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final
from xml.etree import ElementTree

from apnc_plant.robot.links import links_of
from apnc_plant.robot.model import Body, Leg, MassProperties, RobotDescription

Element = ElementTree.Element
_add = ElementTree.SubElement

_INERTIA: Final = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def robot_urdf(robot: RobotDescription) -> str:
    """A robot as URDF, its joints with our signs and reference pose.

    ``trunk`` is the root. Each foot is a ball of the tibia, and a frame of its own at its centre.
    Joints are ``continuous``: our model has no stops. ``effort`` is the stall torque, ``velocity``
    the no-load speed; URDF knows neither the line between them nor a rotor inertia nor a contact
    stiffness: stiffness, damping and rotor inertia stand in a comment.
    """
    root, servo = Element("robot", name=robot.name), robot.servo
    root.append(
        ElementTree.Comment(
            f" servo: stiffness {servo.stiffness!r} N m/rad, damping {servo.damping!r} N m s/rad, "
            f"reflected rotor inertia {servo.reflected_inertia!r} kg m^2 "
        )
    )
    trunk = robot.trunk
    _box(_link(root, "trunk", trunk.loaded(0.0, 0.0)), trunk.center, trunk.body)
    for leg in robot.legs:
        _leg(root, leg, robot)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _leg(root: Element, leg: Leg, robot: RobotDescription) -> None:
    parent, servo = "trunk", robot.servo
    for link, box in zip(links_of(leg), (leg.hip, leg.femur, leg.tibia), strict=True):
        name = f"{leg.name}_{link.name}"
        element = _link(root, name, link.body)
        _box(element, leg.outward(box.com), box)
        joint = _joint(root, f"{leg.name}_{link.joint}", "continuous", parent, name)
        _add(joint, "origin", xyz=_numbers(link.place), rpy=_numbers((0.0, link.pitch, 0.0)))
        _add(joint, "axis", xyz=_numbers(link.axis))
        _add(joint, "limit", effort=repr(servo.stall_torque), velocity=repr(servo.no_load_speed))
        parent = name
    foot = (0.0, 0.0, -leg.tibia_length)
    for kind in ("visual", "collision"):
        shape = _add(element, kind)
        _add(shape, "origin", xyz=_numbers(foot))
        _add(_add(shape, "geometry"), "sphere", radius=repr(robot.contact.foot_radius))
    _add(root, "link", name=f"{leg.name}_foot")
    fixed = _joint(root, f"{leg.name}_foot_joint", "fixed", parent, f"{leg.name}_foot")
    _add(fixed, "origin", xyz=_numbers(foot))


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
    places = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
    values = (repr(float(body.inertia[place])) for place in places)
    _add(inertial, "inertia", dict(zip(_INERTIA, values, strict=True)))
    return link


def _box(link: Element, center: Iterable[float], body: Body) -> None:
    shape = _add(link, "visual")
    _add(shape, "origin", xyz=_numbers(center))
    _add(_add(shape, "geometry"), "box", size=_numbers(body.size))


def _numbers(values: Iterable[float]) -> str:
    """Numbers with every digit they have, and no minus zero."""
    return " ".join(repr(float(value) + 0.0) for value in values)
