"""Positions of the joints and feet of a robot."""

from __future__ import annotations

import numpy as np

from apnc_core.types import Array
from apnc_plant.library import library
from apnc_plant.numbers import robot_numbers
from apnc_plant.robot.model import RobotDescription


class Kinematics:
    """Positions of the legs of a robot at any joint angles.

    Args:
        robot: the robot.
    """

    def __init__(self, robot: RobotDescription) -> None:
        ffi, lib = library()
        self._numbers, self._points = robot_numbers(robot), np.empty((3, 3))
        self._call = lib.plant_leg_points
        self._written = ffi.from_buffer("double[]", self._points)

    def points(self, leg: int, abduction: float, hip: float, knee: float) -> Array:
        """Hip pivot, knee pivot and centre of the foot in the trunk frame [m], shape (3, 3).

        Args:
            leg: number of the leg in the robot's order.
            abduction, hip, knee: joint angles relative to the reference pose [rad].
        """
        self._call(self._numbers.at.leg + leg, abduction, hip, knee, self._written)
        return self._points.copy()

    def feet(self, angles: Array) -> Array:
        """Centres of the feet in the trunk frame [m], shape (n_legs, 3).

        Args:
            angles: abduction, hip and knee of every leg [rad], shape (n_legs, 3).
        """
        return np.array([self.points(leg, *three)[2] for leg, three in enumerate(angles)])
