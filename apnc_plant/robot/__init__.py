"""Robots as data, and the files they are read from."""

from apnc_plant.robot.file import ROBOTS, load_robot
from apnc_plant.robot.model import (
    GRAVITY,
    PAYLOAD_SIZE,
    Body,
    Contact,
    Leg,
    MassProperties,
    RobotDescription,
    RobotDescriptionError,
    Sensor,
    Servo,
    Trunk,
)

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
