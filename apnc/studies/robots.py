"""Robots with a number changed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

Part = TypeVar("Part")


def changed(robot: Part, path: str, change: Callable[[Any], Any]) -> Part:
    """A robot, or a part of it, with one field changed.

    Args:
        robot: a dataclass.
        path: of the field, such as ``trunk.body.com``.
        change: makes the new value of the present one.
    """
    name, _, rest = path.partition(".")
    present = getattr(robot, name)
    new: Any = changed(present, rest, change) if rest else change(present)
    return replace(robot, **{name: new})  # type: ignore[type-var]  # a dataclass


def constant(value: Any) -> Callable[[Any], Any]:
    """The change of any value into this one."""
    return lambda _: value
