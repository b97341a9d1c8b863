"""Coordinates of the tree of joints, the same in all engines."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.robot.links import links_of
from apnc_plant.robot.model import RobotDescription

BASE: Final = 6
"""Coordinates of the floating base: x, y, z [m], yaw, pitch, roll [rad]; the joints follow."""


def joint_signs(robot: RobotDescription) -> Array:
    """Tree coordinate per joint angle, 1 or -1, shape (n_legs, 3).

    Coordinates of hip and knee turn about +y. A leg swings forward about -y, and so does a tibia
    forward, which flexes a knee that lies behind the line from hip to foot.

    Args:
        robot: the robot.
    """
    return np.array([[link.sign for link in links_of(leg)] for leg in robot.legs])
