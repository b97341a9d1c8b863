"""The scene of the report's animation, projected in Python: what is seen at each sample."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc import metrics
from apnc.loop.record import Record
from apnc.report.animation import fixed_data, ground_lines, reach_of, still_parts
from apnc.report.look import LOOK
from apnc.report.skeleton import in_ground, trunk_rotation
from apnc_core.types import Array
from apnc_plant.signals import PLANT_SIGNALS

WIDE: Final = 0.7
"""Share of the width that is compared with the height, as in ``scene.js``."""


class Scene:
    """Points of a walk on a picture; what ``scene.js`` computes in the page.

    Args:
        record: the run, with at least one sample.
        width, height: of the picture [px].
        view: one of ``3d``, ``side``, ``top``, ``front``.

    Attributes:
        standing: which feet stand, shape (T, n).
        radius: of the feet [px].
        elevation: of the camera [rad].
        fixed: what does not change, see ``apnc.report.animation.fixed_data``.
    """

    def __init__(self, record: Record, width: int, height: int, view: str = "3d") -> None:
        self.ground = record.experiment.ground
        plant = {s.name: record.signals[s.name] for s in PLANT_SIGNALS}
        self._still, self._chains = still_parts(record.robot, plant)
        self._reach = reach_of(self._still, self._chains)
        self.fixed = fixed_data(record.robot, record.mass, self.ground, self._reach)
        self._position, self._force = plant["position"], plant["foot_force"]
        self._turn = trunk_rotation(plant["rpy"])
        self._focus = metrics.smooth(self._position)
        self.standing = metrics.stance(self._force[..., 2])
        self._normal = self.ground.rotation()[:, 2]
        self._track = in_ground(self.ground, self._position) * [1.0, 1.0, 0.0]
        self._track = self._track @ self.ground.rotation().T
        self._above = self._focus[0, 2] - self._track[0, 2]
        self.azimuth, self.elevation = LOOK["views"][view]
        self._size = np.array([width, height])
        self._scale = LOOK["zoom"] * min(height, WIDE * width) / self._reach
        self.radius = record.robot.contact.foot_radius * self._scale
        came = self.standing[1:] & ~self.standing[:-1]
        self._prints = [(int(i) + 1, int(leg)) for i, leg in np.argwhere(came)]
        self._drawn: tuple[Array, dict[str, Array]] | None = None

    def project(self, points: Array, i: int) -> Array:
        """Places of points of the world [m] on the picture at a sample: x and y [px], and depth.

        Args:
            points: shape (..., 3).
            i: the sample, on which the camera looks.
        """
        dx, dy, dz = np.moveaxis(points - self._focus[i], -1, 0)
        ca, sa = np.cos(self.azimuth), np.sin(self.azimuth)
        ce, se = np.cos(self.elevation), np.sin(self.elevation)
        depth = dx * ca + dy * sa
        return np.stack(
            [
                0.5 * self._size[0] + (dy * ca - dx * sa) * self._scale,
                LOOK["middle"] * self._size[1] - (dz * ce - depth * se) * self._scale,
                depth * ce + dz * se,
            ],
            axis=-1,
        )

    def _placed(self, points: Array, i: int) -> Array:
        placed: Array = self._position[i] + points @ self._turn[i].T
        return placed

    def legs(self, i: int) -> Array:
        """First and second hip joint, knee and foot of every leg, projected, shape (n, 4, 3)."""
        return self.project(self._placed(self._chains[i], i), i)

    def box(self, i: int) -> tuple[Array, list[Array]]:
        """Corners of the trunk (8, 3) and the lines of the arrow on it, projected."""
        corners = self._placed(self._still["corners"], i)
        along, across = corners[3] - corners[1], corners[5] - corners[1]
        lines = [np.array(line) @ np.array([along, across]) + corners[1] for line in LOOK["arrow"]]
        return self.project(corners, i), [self.project(line, i) for line in lines]

    def depth(self, i: int) -> float:
        """Depth of the trunk, by which it is drawn before or after a leg."""
        return float(self.project(self._position[i], i)[2])

    def _soles(self, i: int) -> Array:
        feet = self._placed(self._chains[i, :, 3], i)
        soles: Array = feet - self.fixed["radius"] * self._normal
        return soles

    def forces(self, i: int) -> list[Array]:
        """Begin and end of the arrow of every force that is large enough, shape (2, 3) each."""
        weight = self.fixed["weight"]
        return [
            self.project(np.stack([sole, sole + force / weight * LOOK["force"]]), i)
            for sole, force in zip(self._soles(i), self._force[i], strict=True)
            if np.linalg.norm(force) >= LOOK["leastForce"] * weight
        ]

    def track(self, i: int) -> Array:
        """Path of the trunk so far on the ground, projected, shape (points, 3)."""
        return self.project(self._track[max(0, i - LOOK["tracked"]) : i + 1 : LOOK["trackStep"]], i)

    def prints(self, i: int) -> list[tuple[Array, int, float]]:
        """Places where feet came down, each with its leg and how fresh it is, 0 to 1."""
        shown = [(k, leg) for k, leg in self._prints if k <= i and i - k <= LOOK["prints"]]
        return [
            (self.project(self._soles(k)[leg], i), leg, 1.0 - (i - k) / LOOK["prints"])
            for k, leg in shown
        ]

    def floor(self, i: int) -> dict[str, Array]:
        """Steps of the lines of the ground around the robot, projected, shape (steps, 2, 3).

        They are cut off at a square around the robot. ``landmarks`` are drawn stronger.
        """
        at, reach = self._focus[i], self._reach
        if self._drawn is None or np.abs(self._drawn[0] - at)[:2].max() > reach:
            self._drawn = at, ground_lines(self.ground, at[None], 2.0 * reach)
        return {
            name: self.project(_cut(np.stack([line[:-1], line[1:]], axis=1), at, reach), i)
            for name, line in self._drawn[1].items()
        }


def _cut(steps: Array, at: Array, reach: float) -> Array:
    """The parts of straight steps within a square seen from above (Liang and Barsky, 1984)."""
    steps = steps[np.isfinite(steps).all(axis=(1, 2))]
    begin, way = steps[:, 0], steps[:, 1] - steps[:, 0]
    first, last = np.zeros(len(steps)), np.ones(len(steps))
    with np.errstate(divide="ignore", invalid="ignore"):
        for k in (0, 1):
            for side in (-1.0, 1.0):
                room = reach - side * (begin[:, k] - at[k])
                share = room / (side * way[:, k])
                first = np.where(side * way[:, k] < 0.0, np.fmax(first, share), first)
                last = np.where(side * way[:, k] > 0.0, np.fmin(last, share), last)
                last = np.where((way[:, k] == 0.0) & (room < 0.0), -1.0, last)
    seen = first < last
    ends = np.stack([first, last], axis=1)[seen, :, None]
    cut: Array = begin[seen, None] + ends * way[seen, None]
    return cut
