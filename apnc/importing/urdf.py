"""URDF files as a tree of parts. Meshes are not needed, so ``package://`` is never followed."""

from __future__ import annotations

import math
import re
from collections import deque
from pathlib import Path
from typing import Final

import numpy as np
from lxml import etree

from apnc.importing.model import (
    NO_BODY,
    Frame,
    Joint,
    Model,
    ModelFileError,
    Motor,
    Part,
    Shape,
    rotation,
)
from apnc.importing.xml_file import Element, described, elements, number, numbers
from apnc_core.types import Array
from apnc_plant.robot import MassProperties

XACRO: Final = "{http://www.ros.org/wiki/xacro}"

_KINDS: Final = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide"}
"""Joints that move, and their kinds; any other that is not fixed keeps its own word."""

_FREE: Final = "floating"

_SERVO: Final = re.compile(
    r"servo: stiffness (\S+) N m/rad, damping (\S+) N m s/rad, "
    r"reflected rotor inertia (\S+) kg m\^2"
)
"""The comment in which our own export says what URDF has no element for."""


def is_xacro(root: Element, path: Path) -> bool:
    """Whether a file still has to be expanded by xacro; an expanded one may keep the namespace."""
    return path.suffix == ".xacro" or any(
        element.tag.startswith(XACRO) or any("${" in text for text in element.attrib.values())
        for element in root.iter("*")
    )


def read_urdf(root: Element, path: Path) -> Model:
    """The robot of a URDF file.

    A link without ``<inertial>`` is a mere frame. If the root link has no mass and a floating
    joint, the base is the link behind that joint.

    Args:
        root: the element ``<robot>``.
        path: of the file, for messages.

    Raises:
        ModelFileError: the file is xacro, or links and joints do not form one tree.
    """
    if is_xacro(root, path):
        raise ModelFileError(
            f"it is xacro, a macro language; expand it first: xacro {path.name} > robot.urdf "
            "(ROS, or pip install xacro)"
        )
    links = _by_name(root, "link")
    joints = _by_name(root, "joint")
    below: dict[str, list[Element]] = {name: [] for name in links}
    above: dict[str, Element] = {}
    for joint in joints.values():
        parent, child = (_link_of(joint, tag, links) for tag in ("parent", "child"))
        if child in above:
            raise ModelFileError(f"link {child} hangs on two joints; allowed: a tree")
        above[child] = joint
        below[parent].append(joint)
    base = _base(links, below, above)
    servo = _servo(root) or Motor()
    parts: list[Part] = []
    waiting: deque[tuple[str, int, Element | None]] = deque([(base, -1, None)])
    while waiting:
        name, carrier, element = waiting.popleft()
        frame = Frame() if element is None else _frame(element)
        moving = None if element is None else _joint(element, servo)
        shapes = _shapes(links[name], name)
        parts.append(Part(name, carrier, frame, _inertial(links[name]), moving, shapes))
        waiting.extend(
            (_link_of(each, "child", links), len(parts) - 1, each) for each in below[name]
        )
    return Model(root.get("name") or path.stem, tuple(parts), {}, _dropped(root, parts, links))


def _by_name(root: Element, tag: str) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in elements(root, tag):
        name = element.get("name")
        if not name or name in found:
            allowed = "names that differ" if name else "a name"
            raise ModelFileError(f"a {tag} is named {name!r}; allowed: {allowed}")
        found[name] = element
    return found


def _link_of(joint: Element, tag: str, links: dict[str, Element]) -> str:
    at = joint.find(tag)
    name = None if at is None else at.get("link")
    if name not in links:
        raise ModelFileError(f"{described(joint)}: {tag} is {name!r}; allowed: a link of the file")
    return str(name)


def _base(
    links: dict[str, Element], below: dict[str, list[Element]], above: dict[str, Element]
) -> str:
    """The floating base."""
    roots = [name for name in links if name not in above]
    if len(roots) != 1:
        named = ", ".join(roots[:5]) or "none"
        raise ModelFileError(f"links without a joint above them: {named}; allowed: one, the root")
    base = roots[0]
    if _inertial(links[base]).mass == 0.0:
        for joint in below[base]:
            if joint.get("type") == _FREE:
                return _link_of(joint, "child", links)
    return base


def _frame(element: Element) -> Frame:
    """The placement that ``<origin>`` says: roll about x, then pitch about y, then yaw about z."""
    origin = element.find("origin")
    roll, pitch, yaw = numbers(origin, "rpy", 3, np.zeros(3))
    x, y, z = np.eye(3)
    turn = rotation(z, yaw) @ rotation(y, pitch) @ rotation(x, roll)
    return Frame(numbers(origin, "xyz", 3, np.zeros(3)), turn)


def _inertial(link: Element) -> MassProperties:
    inertial = link.find("inertial")
    if inertial is None:
        return NO_BODY
    frame = _frame(inertial)
    mass = number(inertial.find("mass"), "value", 0.0)
    entries = inertial.find("inertia")
    xx, xy, xz, yy, yz, zz = (
        number(entries, name, 0.0) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    )
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return MassProperties(mass, frame.position, frame.turn @ inertia @ frame.turn.T)


def _joint(element: Element, servo: Motor) -> Joint | None:
    kind = element.get("type", "")
    if kind in ("fixed", _FREE):
        return None
    limit, dynamics = element.find("limit"), element.find("dynamics")
    servo = _servo(element) or servo
    axis = numbers(element.find("axis"), "xyz", 3, np.array([1.0, 0.0, 0.0]))
    length = float(np.linalg.norm(axis))
    if not length > 0.0:
        raise ModelFileError(f"{described(element)}: axis has no length; allowed: a direction")
    bounded = limit is not None and kind != "continuous"
    lower = number(limit, "lower", 0.0) if bounded else -math.inf
    upper = number(limit, "upper", 0.0) if bounded else math.inf
    motor = Motor(
        effort=_said(number(limit, "effort")),
        velocity=_said(number(limit, "velocity")),
        stiffness=servo.stiffness,
        damping=servo.damping,
        passive=_said(number(dynamics, "damping")),
        friction=_said(number(dynamics, "friction")),
        armature=servo.armature,
    )
    mimic = element.find("mimic")
    follows = "" if mimic is None else mimic.get("joint", "another joint")
    name = element.get("name")
    return Joint(name, _KINDS.get(kind, kind), axis / length, lower, upper, motor, follows)


def _said(value: float) -> float | None:
    return None if math.isnan(value) else value


def _servo(of: Element) -> Motor | None:
    """What the comment of our own export says of all joints, or of one."""
    for comment in of.iterchildren(etree.Comment):
        if found := _SERVO.search(comment.text or ""):
            stiffness, damping, armature = map(float, found.groups())
            return Motor(stiffness=stiffness, damping=damping, armature=armature)
    return None


def _shapes(link: Element, name: str) -> tuple[Shape, ...]:
    found = []
    for kind in ("collision", "visual"):
        for element in elements(link, kind):
            geometry = element.find("geometry")
            for shape in () if geometry is None else geometry.iterchildren("*"):
                half = _half(shape)
                if half is not None:
                    frame, touches = _frame(element), kind == "collision"
                    found.append(Shape(name, str(shape.tag), frame, half, touches))
    return tuple(found)


def _half(shape: Element) -> Array | None:
    match shape.tag:
        case "sphere":
            return np.full(3, number(shape, "radius", 0.0))
        case "box":
            return numbers(shape, "size", 3, np.zeros(3)) / 2.0
        case "cylinder" | "capsule":
            radius, length = number(shape, "radius", 0.0), number(shape, "length", 0.0)
            ends = radius if shape.tag == "capsule" else 0.0
            return np.array([radius, radius, length / 2.0 + ends])
    return None


def _dropped(root: Element, parts: list[Part], links: dict[str, Element]) -> tuple[str, ...]:
    said = []
    meshes = sum(1 for _ in root.iter("mesh"))
    if meshes:
        said.append(f"{meshes} meshes: neither shape nor mass is taken from them")
    behind = len(links) - len(parts)
    if behind:
        said.append(f"{behind} links in front of the floating joint")
    for tag in ("transmission", "gazebo"):
        count = len(elements(root, tag))
        if count:
            said.append(f"{count} elements <{tag}>")
    return tuple(said)
