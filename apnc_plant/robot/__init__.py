"""Robots as data, and the files they are read from.

A module is imported when a name of it is used for the first time: names of legs need no numpy.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from apnc_plant.robot.body import PAYLOAD_SIZE, Body, MassProperties, Trunk
    from apnc_plant.robot.file import ROBOTS, load_robot
    from apnc_plant.robot.joint_map import JointMap
    from apnc_plant.robot.model import (
        GRAVITY,
        Contact,
        JointInFile,
        JointsInFile,
        Leg,
        RobotDescription,
        Sensor,
    )
    from apnc_plant.robot.quantities import RobotDescriptionError
    from apnc_plant.robot.servo import JointServo, LegServos, Servo

_MODULES: Final = {
    "body": ("PAYLOAD_SIZE", "Body", "MassProperties", "Trunk"),
    "file": ("ROBOTS", "load_robot"),
    "joint_map": ("JointMap",),
    "model": (
        "GRAVITY",
        "Contact",
        "JointInFile",
        "JointsInFile",
        "Leg",
        "RobotDescription",
        "Sensor",
    ),
    "quantities": ("RobotDescriptionError",),
    "servo": ("JointServo", "LegServos", "Servo"),
}
_PLACES: Final = {name: module for module, names in _MODULES.items() for name in names}

__all__ = [
    "GRAVITY",
    "PAYLOAD_SIZE",
    "ROBOTS",
    "Body",
    "Contact",
    "JointInFile",
    "JointMap",
    "JointServo",
    "JointsInFile",
    "Leg",
    "LegServos",
    "MassProperties",
    "RobotDescription",
    "RobotDescriptionError",
    "Sensor",
    "Servo",
    "Trunk",
    "load_robot",
]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{__name__}.{_PLACES[name]}"), name)
    globals()[name] = value
    return value
