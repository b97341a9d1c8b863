"""A plant that does nothing but deliver loads."""

from __future__ import annotations

import numpy as np

from apnc.loop.plant import Array
from exudyn_models.conditions import Conditions
from exudyn_models.robot import RobotDescription
from exudyn_models.trace import Trace


class StuckSensor:
    """A robot whose feet bear no load, until all sensors stick at 0.9 of half the weight.

    Args:
        robot: gives the legs and the weight.
        ticks: how many pass before the sensors stick.
    """

    fell = False

    def __init__(self, robot: RobotDescription, ticks: int) -> None:
        self.legs = tuple(leg.name for leg in robot.legs)
        self.mass = robot.mass
        self._load, self._left = 0.9 * robot.weight / 2.0, ticks

    def grf(self) -> Array:
        """Loads [N], shape (n_legs,)."""
        return np.full(len(self.legs), self._load if self._left < 0 else 0.0)

    def set_conditions(self, conditions: Conditions) -> None:
        """Nothing changes."""

    def advance(self, theta_hip: Array, theta_knee: Array, duration: float) -> None:
        """One tick less."""
        self._left -= 1

    def trace(self) -> Trace:
        """Records nothing."""
        return Trace((np.zeros(1),), lambda rows: {})
