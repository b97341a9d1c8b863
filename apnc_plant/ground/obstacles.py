"""The paper's ground: a plane with obstacles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar, Final

import numpy as np

from apnc_plant.ground.surface import Integers, Numbers, Surface
from apnc_plant.robot.model import Array

STEP_HEIGHT: Final = 0.01265
"""Step height of the robot in the terrain study of the paper [m]: obstacle height at R = 1."""

TILE: Final = 4.0
"""Edge of the square of obstacles that is repeated without end [m]."""

CELLS: Final = 80
"""Cells along an edge of the tile, 5 cm each: a foot meets a handful of obstacles per cell."""

SINK_IN: Final = 0.002
"""Depth to which a foot may sink into an obstacle and still be found in its cell [m]."""

CIRCLE: Final = np.linspace(0.0, 2.0 * math.pi, 17)
"""Angles of the points a circle is drawn with [rad]."""


@dataclass(frozen=True)
class Ground(Surface):
    """A plane with caps of balls on it.

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

    A tile of 4 m by 4 m is repeated without end. A ball looks up the cell it is over and tests the
    obstacles listed there, so the cost depends on the density, not on the size of the field.
    """

    kind: ClassVar[str] = "obstacles"

    roughness: float = 0.0
    seed: int = 0
    density: float = 60.0
    diameters: tuple[float, float] = (0.03, 0.1)

    def __post_init__(self) -> None:
        """Check the values."""
        super().__post_init__()
        self._require("roughness", 0.0 <= self.roughness <= 1.0, "0 ... 1")
        self._require("seed", self.seed >= 0, "0 or more")
        self._require("density", 0.0 < self.density <= 1e4, "above 0, up to 10000 per m^2")
        low, high = self.diameters
        fits = 2.0 * STEP_HEIGHT <= low <= high <= 1.0
        self._require("diameters", fits, f"from {2.0 * STEP_HEIGHT} to 1, the smallest first [m]")

    @property
    def top(self) -> float:
        """Height of the obstacles above the plane [m]."""
        return self.roughness * STEP_HEIGHT

    @property
    def flat(self) -> bool:
        """Whether there are no obstacles."""
        return self.roughness == 0.0

    def obstacles(self) -> Array:
        """Balls in one tile, centre in the frame of the ground and radius [m], shape (balls, 4)."""
        return _obstacles(self)

    def elevation(self, x: Array, y: Array) -> Array:
        """Height of the highest obstacle, at least 0 [m]."""
        xs, ys = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        heights = [
            max(0.0, self.rest_height(u, v, 0.0)) for u, v in zip(xs.flat, ys.flat, strict=True)
        ]
        return np.array(heights).reshape(xs.shape)

    def numbers(self, radius: float) -> Numbers:
        """Obstacles; where each cell begins in a list of members, and that list."""
        return _numbers(self, radius)

    @staticmethod
    def touch(
        x: float, y: float, z: float, radius: float, reals: Any, integers: Any, found: Any
    ) -> int:
        """The plane, and every obstacle of the cell that is near enough."""
        count = 0
        if z < radius:
            found[0], found[1], found[2], found[3] = 0.0, 0.0, 1.0, radius - z
            count = 1
        # The remainder of a tiny negative number rounds up to the divisor: hence twice.
        column = int(x / TILE * CELLS % CELLS) % CELLS
        row = int(y / TILE * CELLS % CELLS) % CELLS
        cell = row * CELLS + column
        for k in range(integers[cell], integers[cell + 1]):
            ball = 4 * integers[CELLS * CELLS + 1 + k]
            dx, dy = x - reals[ball], y - reals[ball + 1]
            dx -= TILE * math.floor(dx / TILE + 0.5)
            dy -= TILE * math.floor(dy / TILE + 0.5)
            dz = z - reals[ball + 2]
            distance = math.sqrt(dx * dx + dy * dy + dz * dz)
            depth = radius + reals[ball + 3] - distance
            if depth > 0.0:
                at, share = 4 * count, 1.0 / distance
                found[at], found[at + 1], found[at + 2] = share * dx, share * dy, share * dz
                found[at + 3] = depth
                count += 1
        return count

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Height of a ball's centre over the plane when it just touches what is below it [m]."""
        balls = self.obstacles()
        offset = balls[:, :2] - (x, y)
        offset -= TILE * np.round(offset / TILE)
        room = (balls[:, 3] + radius) ** 2 - (offset**2).sum(axis=1)
        tops = balls[:, 2] + np.sqrt(np.maximum(room, 0.0))
        return float(np.max(tops[room > 0.0], initial=radius))

    def lines(self, x0: float, x1: float, y0: float, y1: float) -> list[Array]:
        """The plane, and of every obstacle its foot and two arcs across its top."""
        lines = Surface.lines(Ground(), x0, x1, y0, y1)
        for x, y, z, radius in self.obstacles():
            for column in range(math.ceil((x0 - x) / TILE), math.floor((x1 - x) / TILE) + 1):
                for row in range(math.ceil((y0 - y) / TILE), math.floor((y1 - y) / TILE) + 1):
                    place = (x + TILE * column, y + TILE * row)
                    lines += _cap(place, z, radius)
        return lines


def _cap(place: tuple[float, float], z: float, radius: float) -> list[Array]:
    foot = math.sqrt(radius**2 - z**2)
    across = foot * np.linspace(-1.0, 1.0, 9)
    over = z + np.sqrt(np.maximum(radius**2 - across**2, z**2))
    flat = np.zeros_like(across)
    ring = (foot * np.cos(CIRCLE), foot * np.sin(CIRCLE), np.zeros_like(CIRCLE))
    shapes = (ring, (across, flat, over), (flat, across, over))
    return [np.column_stack([place[0] + dx, place[1] + dy, dz]) for dx, dy, dz in shapes]


@lru_cache(maxsize=8)
def _obstacles(ground: Ground) -> Array:
    if ground.roughness == 0.0:
        return np.zeros((0, 4))
    random = np.random.default_rng(ground.seed)
    places = random.uniform(0.0, TILE, (round(ground.density * TILE**2), 2))
    radii = random.uniform(*ground.diameters, len(places)) / 2.0
    balls = np.column_stack([places, ground.top - radii, radii])
    balls.flags.writeable = False
    return balls


@lru_cache(maxsize=8)
def _numbers(ground: Ground, radius: float) -> Numbers:
    balls = ground.obstacles()
    first, members = _cells(balls, radius)
    most = int(np.diff(first).max())
    return Numbers(balls.ravel(), np.concatenate([first, members]), 1 + most)


def _cells(obstacles: Array, foot_radius: float) -> tuple[Integers, Integers]:
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
