"""Ground: a plane, level or tilted, with or without obstacles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from exudyn_models.robot.model import Array

Integers = NDArray[np.int64]

STEP_HEIGHT: Final = 0.01265
"""Step height of the robot in the terrain study of the paper [m]: obstacle height at R = 1."""

TILE: Final = 4.0
"""Edge of the square of obstacles that is repeated without end [m]."""

CELLS: Final = 80
"""Cells along an edge of the tile, 5 cm each: a foot meets a handful of obstacles per cell."""

SINK_IN: Final = 0.002
"""Depth to which a foot may sink into an obstacle and still be found in its cell [m]."""


@dataclass(frozen=True)
class Ground:
    """What the robot stands on.

    Args:
        slope: angle by which the ground rises along x [rad].
        roughness: R, height of the obstacles over ``STEP_HEIGHT`` [1], 0 for none.
        seed: of the places and diameters of the obstacles.
        density: obstacles per area [1/m^2].
        diameters: smallest and largest diameter of the balls the obstacles are caps of [m].

    Raises:
        ValueError: a value out of range.

    Section 3.1.3 of Sun, Dai and Manoonpong (2023) gives hemispheres of different diameters,
    randomly distributed and embedded in the ground, and their height: how far each stands out.
    Density and diameters are not published. With these an eighth of the ground is covered at R = 1
    and the flanks rise at 42 degrees (largest ball) to 81 degrees (smallest).
    """

    slope: float = 0.0
    roughness: float = 0.0
    seed: int = 0
    density: float = 60.0
    diameters: tuple[float, float] = (0.03, 0.1)

    def __post_init__(self) -> None:
        """Check the values."""
        if not abs(self.slope) < math.pi / 2:
            raise ValueError(f"slope is {self.slope} rad; allowed: less than a right angle")
        if not 0.0 <= self.roughness <= 1.0:
            raise ValueError(f"roughness is {self.roughness}; allowed: 0 ... 1")
        if self.seed < 0:
            raise ValueError(f"seed is {self.seed}; allowed: 0 or more")
        if not 0.0 < self.density <= 1e4:
            raise ValueError(f"density is {self.density}; allowed: above 0, up to 10000 per m^2")
        low, high = self.diameters
        if not 2.0 * STEP_HEIGHT <= low <= high <= 1.0:
            raise ValueError(
                f"diameters are {low} ... {high} m; allowed: {2.0 * STEP_HEIGHT} ... 1"
            )

    @property
    def height(self) -> float:
        """Height of the obstacles above the plane [m]."""
        return self.roughness * STEP_HEIGHT

    kind = "obstacles"

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "kind": "obstacles",
            "slope": self.slope,
            "roughness": self.roughness,
            "seed": self.seed,
        }

    def text(self) -> str:
        """Words of the command line."""
        return f"obstacles:slope={self.slope},roughness={self.roughness},seed={self.seed}"

    def rotation(self) -> Array:
        """Rotation from ground to world, shape (3, 3); its last column is the normal."""
        c, s = math.cos(self.slope), math.sin(self.slope)
        return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])

    def obstacles(self) -> Array:
        """Balls in one tile, centre in the frame of the ground and radius [m], shape (balls, 4)."""
        if self.roughness == 0.0:
            return np.zeros((0, 4))
        random = np.random.default_rng(self.seed)
        places = random.uniform(0.0, TILE, (round(self.density * TILE**2), 2))
        radii = random.uniform(*self.diameters, len(places)) / 2.0
        return np.column_stack([places, self.height - radii, radii])


def cells(obstacles: Array, foot_radius: float) -> tuple[Integers, Integers]:
    """Which obstacles a foot can touch from each cell of the tile.

    Args:
        obstacles: balls in the tile, shape (balls, 4).
        foot_radius: radius of the foot ball [m].

    Returns:
        Where each cell begins in the list of members, shape (CELLS**2 + 1,), and that list. Cells
        count along x first.
    """
    size = TILE / CELLS
    found: list[list[int]] = [[] for _ in range(CELLS**2)]
    for index, (x, y, z, radius) in enumerate(obstacles):
        # A foot touches where its centre is this far from the axis and no lower than on the plane.
        reach = math.sqrt((radius + foot_radius) ** 2 - (foot_radius - SINK_IN - z) ** 2)
        for row in range(math.floor((y - reach) / size), math.floor((y + reach) / size) + 1):
            for column in range(math.floor((x - reach) / size), math.floor((x + reach) / size) + 1):
                found[row % CELLS * CELLS + column % CELLS].append(index)
    first = np.cumsum([0] + [len(cell) for cell in found], dtype=np.int64)
    return first, np.array([index for cell in found for index in cell], dtype=np.int64)


def lowest_free(obstacles: Array, foot: Array, foot_radius: float) -> float:
    """Height of a foot ball's centre above the plane when it just touches what is below it [m].

    Args:
        obstacles: balls in the tile, shape (balls, 4).
        foot: place of the foot in the frame of the ground [m]; only x and y count.
        foot_radius: radius of the ball [m].
    """
    offset = obstacles[:, :2] - foot[:2]
    offset -= TILE * np.round(offset / TILE)
    room = (obstacles[:, 3] + foot_radius) ** 2 - (offset**2).sum(axis=1)
    tops = obstacles[:, 2] + np.sqrt(np.maximum(room, 0.0))
    return float(np.max(tops[room > 0.0], initial=foot_radius))
