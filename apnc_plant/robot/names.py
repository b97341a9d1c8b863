"""Names that files, XML and topics allow."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from apnc_plant.robot.model import RobotDescription


def plain_name(name: str) -> str:
    """The name with letters, digits and ``_`` only, which paths, XML, ROS topics and USD allow.

    Args:
        name: any name. Other characters become ``_``; a leading digit gets a ``_`` before it.
    """
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return f"_{plain}" if not plain or plain[0].isdigit() else plain


def plain_names(names: Iterable[str]) -> tuple[str, ...]:
    """Plain names that differ: if two are the same, ``_`` is appended to the later one."""
    taken: list[str] = []
    for name in map(plain_name, names):
        while name in taken:
            name += "_"
        taken.append(name)
    return tuple(taken)


def plainly_named(robot: RobotDescription) -> RobotDescription:
    """The robot with plain names of its own and of its legs."""
    names = plain_names(leg.name for leg in robot.legs)
    legs = tuple(replace(leg, name=name) for leg, name in zip(robot.legs, names, strict=True))
    return replace(robot, name=plain_name(robot.name), legs=legs)
