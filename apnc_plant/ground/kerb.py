"""A step across the way."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from apnc_plant.ground.surface import Numbers, Surface
from apnc_plant.robot.model import Array


@dataclass(frozen=True)
class Kerb(Surface):
    """A step up, and down again if it has a length; without end to both sides.

    Args:
        slope: angle by which the whole ground rises along x [rad].
        at: where it begins [m].
        height: how high it is [m].
        length: after which it goes down again [m]; 0: it does not.

    Raises:
        ValueError: a value out of range.

    The contact is exact. A ball touches the plane, where that is free, and the kerb, which is a
    convex body, at its point nearest to the centre: top, face or edge. With its centre inside the
    kerb, deeper than a foot gets, it is pushed out through the nearest of the three.
    """

    kind: ClassVar[str] = "kerb"

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
        """Where it goes down again [m]."""
        return self.at + (self.length or math.inf)

    @property
    def top(self) -> float:
        """Height of the kerb [m]."""
        return self.height

    def elevation(self, x: Array, y: Array) -> Array:
        """Height of the kerb on it, else 0 [m]."""
        on = (x >= self.at) & (x <= self.end)
        return np.where(on, self.height, 0.0) + np.zeros_like(y)

    def numbers(self, radius: float) -> Numbers:
        """Begin, end and height [m]."""
        return Numbers(np.array([self.at, self.end, self.height]), np.zeros(1, np.int64), 2)

    @staticmethod
    def touch(
        x: float, y: float, z: float, radius: float, reals: Any, integers: Any, found: Any
    ) -> int:
        """The plane where it is free, and the nearest point of the kerb."""
        begin, end, height = reals[0], reals[1], reals[2]
        count = 0
        if z < radius and (x < begin or x > end):
            found[0], found[1], found[2], found[3] = 0.0, 0.0, 1.0, radius - z
            count = 1
        dx = x - min(max(x, begin), end)
        dz = z - min(z, height)
        distance = math.sqrt(dx * dx + dz * dz)
        if distance > 0.0:
            nx, nz = dx / distance, dz / distance
        else:
            up, back, on = height - z, x - begin, end - x
            nx, nz = 0.0, 1.0
            distance = -up
            if back < up and back <= on:
                nx, nz, distance = -1.0, 0.0, -back
            elif on < up:
                nx, nz, distance = 1.0, 0.0, -on
        if radius > distance:
            at = 4 * count
            found[at], found[at + 1], found[at + 2], found[at + 3] = nx, 0.0, nz, radius - distance
            count += 1
        return count

    def _line(self, x: Any, y: Any) -> Array:
        """A line over the kerb gets its edges as points, both ends of each face."""
        line = super()._line(x, y)
        first = int(np.searchsorted(line[:, 0], self.at, "left"))
        last = int(np.searchsorted(line[:, 0], self.end, "right"))
        for place, before, heights in (
            (self.end, last, (self.height, 0.0)),
            (self.at, first, (0.0, self.height)),
        ):
            if 0 < before < len(line):
                face = [(place, line[0, 1], z) for z in heights]
                line = np.insert(line, before, face, axis=0)
        return line
