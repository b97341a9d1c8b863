"""A ground of one's own: a low hill across which Lilibot walks."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

import apnc
from apnc_plant.ground import Numbers


@dataclass(frozen=True)
class Hill(apnc.Surface):
    """The top of a large ball that stands out of the plane; lengths in m."""

    kind: ClassVar[str] = "hill"

    at: float = 0.6
    height: float = 0.015
    radius: float = 1.5

    @property
    def top(self) -> float:
        """Greatest height over the plane."""
        return self.height

    def elevation(self, x: Any, y: Any) -> Any:
        """Height over the plane."""
        below = np.maximum(self.radius**2 - (x - self.at) ** 2 - y**2, 0.0)
        return np.maximum(0.0, self.height - self.radius + np.sqrt(below))

    def numbers(self, radius: float) -> Numbers:
        """What touch() reads, and how many places a foot can touch at a time."""
        reals = np.array([self.at, self.height - self.radius, self.radius])
        return Numbers(reals, np.zeros(1, np.int64), contacts=2)

    @staticmethod
    def touch(x: float, y: float, z: float, r: float, reals: Any, integers: Any, found: Any) -> int:
        """Normal and depth where a foot, a ball of radius r, touches; compiled by numba."""
        count = 0
        if z < r:  # the plane
            found[0], found[1], found[2], found[3] = 0.0, 0.0, 1.0, r - z
            count = 1
        dx, dz = x - reals[0], z - reals[1]
        away = math.sqrt(dx * dx + y * y + dz * dz)
        if away < reals[2] + r:  # the hill
            k = 4 * count
            found[k], found[k + 1], found[k + 2] = dx / away, y / away, dz / away
            found[k + 3] = reals[2] + r - away
            count += 1
        return count


record = apnc.simulate(apnc.Experiment(mi=0.15, duration=15, ground=Hill()))
x, height = record.plant["position"][:, 0], record.plant["position"][:, 2]
print(f"{record.end} at {record.ended_at:.1f} s, {x[-1]:.2f} m ahead")
for place in (0.1, 0.6, 1.1):
    near = np.abs(x - place) < 0.05
    print(f"trunk {1e3 * height[near].mean():.1f} mm high around x = {place} m")
