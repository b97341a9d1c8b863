"""Robots as data, and the files they are read from."""

from apnc_plant.robot.file import ROBOTS, load_robot
from apnc_plant.robot.joint_map import JointMap
from apnc_plant.robot.model import (
    GRAVITY,
    PAYLOAD_SIZE,
    Body,
    Contact,
    JointInFile,
    JointsInFile,
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
    "JointInFile",
    "JointMap",
    "JointsInFile",
    "Leg",
    "MassProperties",
    "RobotDescription",
    "RobotDescriptionError",
    "Sensor",
    "Servo",
    "Trunk",
    "load_robot",
]
