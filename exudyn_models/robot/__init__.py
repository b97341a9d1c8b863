"""Robots as data, and the files they are read from."""

from exudyn_models.robot.file import ROBOTS, RobotDescriptionError, load_robot
from exudyn_models.robot.model import RobotDescription

__all__ = ["ROBOTS", "RobotDescription", "RobotDescriptionError", "load_robot"]
