"""A plane, level or tilted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from apnc_core.types import Array
from apnc_plant.ground.ground import Ground
from apnc_plant.ground.in_c import Numbers


@dataclass(frozen=True)
class Plane(Ground):
    """A plane; see :class:`Ground` for its slope."""

    kind: ClassVar[str] = "plane"
    kind_in_c: ClassVar[str] = "PLANT_PLANE"

    @property
    def top(self) -> float:
        """Height of the plane [m]."""
        return 0.0

    @property
    def flat(self) -> bool:
        """True, unless a subclass has its own touch function."""
        return not self.touches_itself

    def elevation(self, x: Array, y: Array) -> Array:
        """0 everywhere [m]."""
        return np.zeros(np.broadcast(x, y).shape)

    def numbers(self, radius: float) -> Numbers:
        """A plane needs no numbers."""
        return Numbers(contacts=1)

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Radius of the ball [m]."""
        return radius
