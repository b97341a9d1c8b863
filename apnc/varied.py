"""Robots whose uncertain numbers are off by chance, as those of a real robot are."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Any, Final, TypeVar

import numpy as np

from apnc_plant.robot import RobotDescription

Part = TypeVar("Part")

UNCERTAIN: Final = frozenset({
    "mass", "com_side_offset",
    "stiffness", "damping", "stall_torque", "no_load_speed", "reflected_inertia", "latency",
    "joint_damping", "dry_friction", "damping_depth", "friction", "friction_speed",
    "delay", "time_constant", "noise",
})  # fmt: skip
"""Fields of a robot and its parts that are multiplied by a factor. Lengths and angles, which a
drawing gives, are none of them; nor is what the controller is set to."""

INERTIA: Final = "inertia"
"""Field that is off as much as the mass of its body."""

SHIFTED: Final = "com"
"""Field that is shifted instead: a centre of mass may be at 0."""


def varied(robot: RobotDescription, share: float, rng: np.random.Generator) -> RobotDescription:
    """A copy of a robot with every uncertain number off by chance, each by itself.

    Masses, with the inertia that belongs to them, and numbers of servo, contact and sensor are
    multiplied by factors within 1 - share and 1 + share. Every coordinate of a centre of mass is
    shifted by at most the share of half of its body's edge along that axis; sideways, this one of
    the trunk is not, because seeds do that. All legs are off alike, as they are of one make.

    Args:
        robot: the robot.
        share: how far a number is off at most [1], at least 0 and below 1.
        rng: where chance comes from; the same state gives the same robot.

    Raises:
        ValueError: the share is not allowed.

    Pitfall: a controller knows the weight that was told to it. To keep it in the dark, set its
    ``robot_weight`` to that of the robot itself.
    """
    if not 0.0 <= share < 1.0:
        raise ValueError(f"share is {share}; allowed: 0 and more, below 1")
    return _Chance(share, rng).part(robot, "robot")


class _Chance:
    """Draws by the name of a number, so that numbers of the same name are off alike."""

    def __init__(self, share: float, rng: np.random.Generator) -> None:
        self._share, self._rng = share, rng
        self._drawn: dict[str, float] = {}
        self._made: dict[tuple[Any, str], Any] = {}

    def off(self, name: str) -> float:
        """How far a number is off, -share to share [1]."""
        if name not in self._drawn:
            self._drawn[name] = float(self._rng.uniform(-self._share, self._share))
        return self._drawn[name]

    def part(self, part: Part, name: str) -> Part:
        """A copy of a robot or of one of its parts; equal parts of several legs are copied once."""
        if (part, name) not in self._made:
            self._made[part, name] = self._copy(part, name)
        made: Part = self._made[part, name]
        return made

    def _copy(self, part: Part, name: str) -> Part:
        found: dict[str, Any] = {}
        for each in fields(part):  # type: ignore[arg-type]  # a dataclass
            value, inside = getattr(part, each.name), f"{name}.{each.name}"
            if value is None:  # what a leg has none of its own of
                continue
            if each.name == INERTIA:
                scale = 1.0 + self.off(f"{name}.mass")
                found[each.name] = tuple(scale * moment for moment in value)
            elif each.name in UNCERTAIN:
                found[each.name] = value * (1.0 + self.off(inside))
            elif each.name == SHIFTED:
                found[each.name] = self._shifted(value, part.size, inside)  # type: ignore[attr-defined]  # a body
            elif is_dataclass(value):
                found[each.name] = self.part(value, inside)
            elif isinstance(value, tuple) and value and all(map(is_dataclass, value)):
                found[each.name] = tuple(self.part(entry, inside) for entry in value)
        return replace(part, **found)  # type: ignore[type-var]  # as above

    def _shifted(self, com: Any, size: Any, name: str) -> tuple[float, ...]:
        seeded = name == "robot.trunk.com"
        moves = [self.off(f"{name}.{axis}") for axis in "xyz"]
        moves[1] *= not seeded
        return tuple(c + m * edge / 2.0 for c, m, edge in zip(com, moves, size, strict=True))
