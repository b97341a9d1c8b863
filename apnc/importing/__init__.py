"""Reads robots of other people, URDF and MJCF, into robot files."""

from apnc.importing.importer import ImportedRobot, import_robot
from apnc.importing.model import ModelFileError

__all__ = ["ImportedRobot", "ModelFileError", "import_robot"]
