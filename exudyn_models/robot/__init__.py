"""Robots as data, and the files they are read from."""

from exudyn_models.robot.file import ROBOTS, load_robot
from exudyn_models.robot.model import (
    GRAVITY,
    PAYLOAD_SIZE,
    Body,
    Contact,
    Leg,
    MassProperties,
    RobotDescription,
    Sensor,
    Servo,
    Trunk,
)
from exudyn_models.robot.quantity import RobotDescriptionError

__all__ = [
    "GRAVITY",
    "PAYLOAD_SIZE",
    "ROBOTS",
    "Body",
    "Contact",
    "Leg",
    "MassProperties",
    "RobotDescription",
    "RobotDescriptionError",
    "Sensor",
    "Servo",
    "Trunk",
    "load_robot",
]
