"""The paper's ground: a plane with obstacles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.chance import checked_seed
from apnc_plant.ground.ground import Ground
from apnc_plant.ground.in_c import GroundInC, Numbers
from apnc_plant.library import library

STEP_HEIGHT: Final = 0.01265
"""Step height of the robot in the terrain study of the paper [m]; height of obstacles at R = 1."""

TILE: Final = 4.0
"""Edge of the square tile of obstacles, which is repeated without end [m]."""

CELLS: Final = 80
"""Cells along an edge of the tile, 5 cm each, so that a cell lists only a few obstacles."""

SINK_IN: Final = 0.002
"""Depth to which a foot of Lilibot may sink into an obstacle and still be found in its cell [m]."""

CIRCLE: Final = np.linspace(0.0, 2.0 * math.pi, 17)
"""Angles of the points with which a circle is drawn [rad]."""


@dataclass(frozen=True)
class Obstacles(Ground):
    """A plane with caps of balls on it.

    Args:
        slope: angle by which the ground rises along x [rad].
        roughness: R, height of the obstacles over ``STEP_HEIGHT`` [1], 0 for none.
        seed: seed of the positions and diameters of the obstacles.
        density: obstacles per area [1/m^2].
        diameters: smallest and largest diameter of the balls whose caps are the obstacles [m].
        scale: all lengths over these, heights included [1]: a robot with legs twice as long as
            Lilibot's walks at 2 over what Lilibot does at 1.

    Raises:
        ValueError: a value out of range.

    Section 3.1.3 of Sun, Dai and Manoonpong (2023) describes hemispheres of different diameters,
    which are randomly distributed and embedded in the ground, and their height over the ground.
    Density and diameters are not published. With the defaults an eighth of the ground is covered
    at R = 1, and the flanks rise at 42 degrees (largest ball) to 81 degrees (smallest).

    A tile of 4 m by 4 m is repeated without end. The cell under a foot lists the obstacles that the
    foot can touch, so the cost depends on the density and not on the size of the field.
    """

    kind: ClassVar[str] = "obstacles"
    kind_in_c: ClassVar[str] = "PLANT_OBSTACLES"

    roughness: float = 0.0
    seed: int = 0
    density: float = 60.0
    diameters: tuple[float, float] = (0.03, 0.1)
    scale: float = 1.0

    def __post_init__(self) -> None:
        """Check the values."""
        super().__post_init__()
        self._require("roughness", 0.0 <= self.roughness <= 1.0, "0 ... 1")
        checked_seed(self.seed)
        self._require("density", 0.0 < self.density <= 1e4, "above 0, up to 10000 per m^2")
        low, high = self.diameters
        self._require("scale", 0.0 < self.scale <= 1.0 / high, f"above 0, up to {1.0 / high:g}")
        fits = 2.0 * STEP_HEIGHT <= low <= high <= 1.0
        self._require("diameters", fits, f"from {2.0 * STEP_HEIGHT} to 1, the smallest first [m]")

    @property
    def top(self) -> float:
        """Height of the obstacles above the plane [m]."""
        return self.roughness * STEP_HEIGHT * self.scale

    @property
    def balls(self) -> int:
        """Obstacles in a tile."""
        return round(self.density / self.scale**2 * TILE**2)

    @property
    def flat(self) -> bool:
        """Whether there are neither obstacles nor its own touch function."""
        return self.roughness == 0.0 and not self.touches_itself

    def obstacles(self) -> Array:
        """Balls of one tile: centre in the frame of the ground and radius [m], shape (balls, 4)."""
        return _obstacles(self)

    def elevation(self, x: Array, y: Array) -> Array:
        """Height of the highest obstacle, at least 0 [m]."""
        xs, ys = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        ground = GroundInC(self, 0.0)
        points = zip(xs.flat, ys.flat, strict=True)
        return np.array([ground.rest_height(u, v, 0.0) for u, v in points]).reshape(xs.shape)

    def numbers(self, radius: float) -> Numbers:
        """Reals: tile, cells along its edge, balls. Integers: start of each cell in a list of
        balls, then that list."""
        return Numbers(contacts=1) if self.flat else _numbers(self, radius)

    def lines(self, x0: float, x1: float, y0: float, y1: float) -> list[Array]:
        """Lines of the plane, and for every obstacle its outline and two arcs across its top."""
        lines = Ground.lines(Obstacles(), x0, x1, y0, y1)
        for x, y, z, radius in self.obstacles():
            for column in range(math.ceil((x0 - x) / TILE), math.floor((x1 - x) / TILE) + 1):
                for row in range(math.ceil((y0 - y) / TILE), math.floor((y1 - y) / TILE) + 1):
                    center = (x + TILE * column, y + TILE * row)
                    lines += _cap(center, z, radius)
        return lines


def _cap(center: tuple[float, float], z: float, radius: float) -> list[Array]:
    foot = math.sqrt(radius**2 - z**2)
    across = foot * np.linspace(-1.0, 1.0, 9)
    over = z + np.sqrt(np.maximum(radius**2 - across**2, z**2))
    flat = np.zeros_like(across)
    ring = (foot * np.cos(CIRCLE), foot * np.sin(CIRCLE), np.zeros_like(CIRCLE))
    shapes = (ring, (across, flat, over), (flat, across, over))
    return [np.column_stack([center[0] + dx, center[1] + dy, dz]) for dx, dy, dz in shapes]


@lru_cache(maxsize=8)
def _obstacles(ground: Obstacles) -> Array:
    if ground.roughness == 0.0:
        return np.zeros((0, 4))
    balls = _numbers(ground, 0.0).reals[2:].reshape(-1, 4)
    balls.flags.writeable = False
    return balls


@lru_cache(maxsize=8)
def _numbers(ground: Obstacles, radius: float) -> Numbers:
    ffi, lib = library()
    smallest, largest = (diameter * ground.scale for diameter in ground.diameters)
    fields = {
        "seed": ground.seed,
        "balls": ground.balls,
        "cells": CELLS,
        "tile": TILE,
        "height": ground.top,
        "smallest": smallest,
        "largest": largest,
        "foot_radius": radius,
        "sink_in": SINK_IN * ground.scale,
    }
    field = ffi.new("plant_field *", fields)
    reals = np.empty(lib.plant_field_reals(field))
    integers = np.empty(lib.plant_field_integers(field), np.int64)
    most = lib.plant_field_fill(
        field, ffi.from_buffer("double[]", reals), ffi.from_buffer("int64_t[]", integers)
    )
    return Numbers(reals, integers, most)
