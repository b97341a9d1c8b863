"""The numbers of a robot, and how sure each of them is before the robot itself was measured.

The reasons are those of docs/robots/lilibot.md. They hold for a robot of this class: servos of a
data sheet, lengths of a drawing, everything else estimated.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, is_dataclass, replace
from typing import Any, Final

from apnc_plant.robot import RobotDescription

Change = Callable[[RobotDescription, float], RobotDescription]
"""Function of a robot and how far a number is off."""


@dataclass(frozen=True)
class Known:
    """A number, and how sure it is.

    Args:
        change: the robot with the number off by a factor [1], or by a shift in ``unit``.
        low, high: between which the real one lies, in the same terms.
        reason: why it lies there.
        unit: of a shift; empty for a factor.
        far: largest shift that is tried, to both sides.
        times: largest factor that is tried, to both sides [1].
        only_above: whether it cannot be shifted below its value.
    """

    change: Change
    low: float
    high: float
    reason: str
    unit: str = ""
    far: float = 0.0
    times: float = 8.0
    only_above: bool = False

    @property
    def nothing(self) -> float:
        """The factor or shift that changes nothing."""
        return 0.0 if self.unit else 1.0


def _at(part: Any, path: str, new: Callable[[Any], Any]) -> Any:
    """A copy of a part with a field changed; of several alike, such as legs, in each of them."""
    if isinstance(part, tuple) and part and is_dataclass(part[0]):
        return tuple(_at(each, path, new) for each in part)
    name, _, rest = path.partition(".")
    present = getattr(part, name)
    changed: dict[str, Any] = {name: _at(present, rest, new) if rest else new(present)}
    return replace(part, **changed)


def _times(*paths: str) -> Change:
    """Multiply fields, whole vectors too, by the factor."""

    def scaled(value: Any, factor: float) -> Any:
        if isinstance(value, tuple):
            return tuple(factor * each for each in value)
        return factor * value

    def change(robot: RobotDescription, factor: float) -> RobotDescription:
        for path in paths:
            robot = _at(robot, path, lambda value: scaled(value, factor))
        return robot

    return change


def _along(path: str, axis: int) -> Change:
    """Multiply one coordinate of a vector by the factor."""

    def change(robot: RobotDescription, factor: float) -> RobotDescription:
        return _at(robot, path, lambda v: (*v[:axis], factor * v[axis], *v[axis + 1 :]))  # type: ignore[no-any-return]

    return change


def _shifted(path: str, axis: int) -> Change:
    """Shift one coordinate of a vector [mm]."""

    def change(robot: RobotDescription, by: float) -> RobotDescription:
        return _at(robot, path, lambda v: (*v[:axis], v[axis] + 1e-3 * by, *v[axis + 1 :]))  # type: ignore[no-any-return]

    return change


def _more(path: str, unit: float) -> Change:
    """Add to a field, in a unit [SI]."""

    def change(robot: RobotDescription, by: float) -> RobotDescription:
        return _at(robot, path, lambda value: value + unit * by)  # type: ignore[no-any-return]

    return change


_MS, _DEGREE = 1e-3, math.pi / 180.0

KNOWN: Final = {
    "mass of the trunk": Known(
        _times("trunk.mass"), 0.8, 1.2, "total mass published; follows from the links' masses",
        times=3.0,
    ),
    "mass of the hip links": Known(
        _times("legs.hip.mass"), 0.9, 1.1, "servo on its data sheet, bracket estimated"
    ),
    "mass of the femurs": Known(
        _times("legs.femur.mass"), 0.8, 1.2, "servo on its data sheet, plates estimated"
    ),
    "mass of the tibiae": Known(
        _times("legs.tibia.mass"), 0.65, 1.35, "printed part, load cell and rubber estimated"
    ),
    "edges of the trunk": Known(
        _times("trunk.size"), 0.85, 1.15, "its inertia is that of a box, 30 % either way"
    ),
    "edges of the links": Known(
        _times("legs.hip.size", "legs.femur.size", "legs.tibia.size"),
        0.85, 1.15, "their inertia is that of a box, 30 % either way",
    ),
    "sideways error of the mass": Known(
        _times("trunk.com_side_offset"), 1 / 3, 3.0, "order of magnitude"
    ),
    "hip spacing along": Known(
        _along("legs.mount", 0), 0.95, 1.05, "read off the drawing, 5 mm", times=2.0,
    ),
    "hip spacing across": Known(
        _along("legs.mount", 1), 0.92, 1.08, "read off the drawing, 5 mm", times=2.0,
    ),
    "length of the femurs": Known(
        _times("legs.femur_length"), 0.99, 1.01, "drawing, pivot to pivot", times=1.5,
    ),
    "length of the tibiae": Known(
        _times("legs.tibia_length"), 0.99, 1.01, "drawing, knee to middle of the foot", times=1.5,
    ),
    "radius of the feet": Known(
        _times("contact.foot_radius"), 0.92, 1.08, "published as about 24 mm"
    ),
    "P of the servos": Known(
        _times("servo.stiffness"), 0.8, 1.2, "a setting; its unit differs from the data sheet's"
    ),
    "D of the servos": Known(
        _times("servo.damping"), 0.8, 1.2, "back-EMF on the data sheet, friction of the gear not"
    ),
    "stall torque": Known(
        _times("servo.stall_torque"), 0.9, 1.05, "data sheet at 12 V; a battery has 11 to 12.6 V"
    ),
    "no-load speed": Known(
        _times("servo.no_load_speed"), 0.9, 1.05, "data sheet at 12 V; a battery has 11 to 12.6 V"
    ),
    "rotor inertia": Known(
        _times("servo.reflected_inertia"), 0.5, 2.0, "not published; class of the servo"
    ),
    "stiffness of the feet": Known(
        _times("contact.stiffness"), 0.5, 2.0, "rubber of unknown hardness"
    ),
    "damping of the feet": Known(
        _times("contact.damping"), 0.5, 2.0, "rubber of unknown loss"
    ),
    "damping depth": Known(
        _times("contact.damping_depth"), 0.5, 2.0, "numerical: smooths the first touch"
    ),
    "friction": Known(
        _times("contact.friction"), 0.75, 1.25, "rubber on a dry floor, 0.6 to 1.0"
    ),
    "friction speed": Known(
        _times("contact.friction_speed"), 0.5, 2.0, "numerical: there is no sticking"
    ),
    "delay of the sensors": Known(
        _more("sensor.delay", _MS), 0.0, 40.0, "sensor, bus and computer", "ms", 100.0,
        only_above=True,
    ),
    "filter of the sensors": Known(
        _times("sensor.time_constant"), 0.9, 1.1, "published in the authors' code"
    ),
    "noise of the sensors": Known(
        _times("sensor.noise"), 1 / 3, 3.0, "estimated"
    ),
    "centre of mass ahead": Known(
        _shifted("trunk.com", 0), -10.0, 10.0, "place of battery and computer", "mm", 50.0
    ),
    "centre of mass up": Known(
        _shifted("trunk.com", 2), -10.0, 10.0, "place of battery and computer", "mm", 50.0
    ),
    "hip axis up": Known(
        _shifted("legs.hip_offset", 2), -5.0, 5.0, "read off the drawing", "mm", 30.0
    ),
    "zero of the hips": Known(
        _more("legs.femur_angle", _DEGREE), -2.0, 2.0, "a tooth of the horn, trimmed", "deg", 20.0
    ),
    "zero of the knees": Known(
        _more("legs.tibia_angle", _DEGREE), -2.0, 2.0, "a tooth of the horn, trimmed", "deg", 20.0
    ),
    "latency of the servos": Known(
        _more("servo.latency", _MS), 0.0, 10.0, "lag of the bus", "ms", 50.0, only_above=True
    ),
}  # fmt: skip
"""By name in table and picture. What all legs have alike is off in all of them alike."""
