"""A plane, level or tilted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from apnc_plant.ground.surface import Numbers, Surface
from apnc_plant.robot.model import Array


@dataclass(frozen=True)
class Plane(Surface):
    """A plane; see :class:`Surface` for its slope."""

    kind: ClassVar[str] = "plane"

    @property
    def top(self) -> float:
        """Height of the plane [m]."""
        return 0.0

    @property
    def flat(self) -> bool:
        """A plane is flat."""
        return True

    def elevation(self, x: Array, y: Array) -> Array:
        """0 everywhere [m]."""
        return np.zeros(np.broadcast(x, y).shape)

    def numbers(self, radius: float) -> Numbers:
        """None are needed."""
        return Numbers(np.zeros(1), np.zeros(1, np.int64), contacts=1)

    @staticmethod
    def touch(
        x: float, y: float, z: float, radius: float, reals: Any, integers: Any, found: Any
    ) -> int:
        """A ball touches at its lowest point."""
        if z >= radius:
            return 0
        found[0], found[1], found[2], found[3] = 0.0, 0.0, 1.0, radius - z
        return 1

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Radius of the ball [m]."""
        return radius
