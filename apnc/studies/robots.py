"""Copies of a robot with some numbers changed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

from apnc_plant.robot import RobotDescription

Part = TypeVar("Part")


def changed(robot: Part, path: str, change: Callable[[Any], Any]) -> Part:
    """A copy of a robot, or of a part of it, with one field changed.

    Args:
        robot: robot or part, a dataclass.
        path: names of the parts and of the field, such as ``trunk.com``.
        change: function from the present value to the new one.
    """
    name, _, rest = path.partition(".")
    present = getattr(robot, name)
    new: Any = changed(present, rest, change) if rest else change(present)
    return replace(robot, **{name: new})  # type: ignore[type-var]  # a dataclass


def symmetric(robot: RobotDescription) -> RobotDescription:
    """The robot with its centre of mass in the middle plane and sensors without noise."""
    centred = changed(robot, "trunk.com_side_offset", constant(0.0))
    return changed(centred, "sensor.noise", constant(0.0))


def constant(value: Any) -> Callable[[Any], Any]:
    """A change that ignores the present value and gives this one."""
    return lambda _: value
