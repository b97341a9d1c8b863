"""Robots as data, and the files they are read from."""

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
