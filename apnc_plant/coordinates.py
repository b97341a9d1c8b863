"""Coordinates of the tree of joints, the same in all engines."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.robot.links import links_of
from apnc_plant.robot.model import RobotDescription

BASE: Final = 6
"""Coordinates of the floating base: x, y, z [m], yaw, pitch, roll [rad]; the joints follow."""


class Joints:
    """Converts between joint angles, in the order of ``signals.JOINTS``, and the tree.

    In the tree the joints of a leg stand from the trunk outward. Its coordinates turn about +x, +y
    or +z, so a hip turns back and a knee lets the tibia swing back.

    Args:
        robot: the robot.
    """

    def __init__(self, robot: RobotDescription) -> None:
        links = [links_of(leg) for leg in robot.legs]
        self._angle = np.array([[link.angle for link in leg] for leg in links])
        self._place = np.argsort(self._angle, axis=1)
        self._sign = np.array([[link.sign for link in leg] for leg in links])

    def in_tree(self, angles: Array) -> Array:
        """Coordinates of the tree [rad], shape (n_legs, 3), from joint angles of that shape."""
        return np.asarray(np.take_along_axis(angles, self._angle, axis=1) * self._sign)

    def angles(self, tree: Array) -> Array:
        """Joint angles, from coordinates of the tree, both of the shape (..., n_legs, 3)."""
        return self.by_angle(tree * self._sign)

    def by_angle(self, tree: Array) -> Array:
        """What has no sign, in the order of the joint angles; shapes as of :meth:`angles`."""
        place = np.broadcast_to(self._place, tree.shape)
        return np.asarray(np.take_along_axis(tree, place, axis=-1))
