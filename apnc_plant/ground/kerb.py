"""A kerb across the way of the robot."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from apnc_core.types import Array
from apnc_plant.ground.ground import Ground
from apnc_plant.ground.in_c import Numbers


@dataclass(frozen=True)
class Kerb(Ground):
    """A step up, and down again if it has a length. It extends without end to both sides.

    Args:
        slope: angle by which the whole ground rises along x [rad].
        at: position along x at which it begins [m].
        height: its height [m].
        length: length after which it goes down again [m]; 0: it has no end.

    Raises:
        ValueError: a value out of range.

    The contact is exact. A ball touches the plane where there is no kerb, and it touches the kerb,
    which is a convex body, at the point nearest to the ball's centre: top, face or edge. If the
    centre is inside the kerb, deeper than a foot gets, the ball is pushed out through the nearest
    surface.
    """

    kind: ClassVar[str] = "kerb"
    kind_in_c: ClassVar[str] = "PLANT_KERB"

    at: float = 0.5
    height: float = 0.006
    length: float = 0.0

    def __post_init__(self) -> None:
        """Check the values."""
        super().__post_init__()
        self._require("at", math.isfinite(self.at), "a finite number [m]")
        self._require("height", 0.0 < self.height <= 1.0, "above 0, up to 1 [m]")
        self._require("length", 0.0 <= self.length < math.inf, "0 or more [m]")

    @property
    def end(self) -> float:
        """Position along x at which it goes down again [m]."""
        return self.at + (self.length or math.inf)

    @property
    def top(self) -> float:
        """Height of the kerb [m]."""
        return self.height

    def elevation(self, x: Array, y: Array) -> Array:
        """Height of the kerb within its length, else 0 [m]."""
        on = (x >= self.at) & (x <= self.end)
        return np.where(on, self.height, 0.0) + np.zeros_like(y)

    def numbers(self, radius: float) -> Numbers:
        """Begin, end and height [m]."""
        return Numbers(np.array([self.at, self.end, self.height]), contacts=2)

    def _line(self, x: Any, y: Any) -> Array:
        """A line over the kerb has both ends of each face among its points."""
        line = super()._line(x, y)
        first = int(np.searchsorted(line[:, 0], self.at, "left"))
        last = int(np.searchsorted(line[:, 0], self.end, "right"))
        for position, before, heights in (
            (self.end, last, (self.height, 0.0)),
            (self.at, first, (0.0, self.height)),
        ):
            if 0 < before < len(line):
                face = [(position, line[0, 1], z) for z in heights]
                line = np.insert(line, before, face, axis=0)
        return line
