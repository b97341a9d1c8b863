"""What the animation draws, packed for the browser: ground, legs, trunk, forces, contacts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.report.encoding import Signal, packed
from apnc.report.lines import Run
from apnc.report.look import LOOK
from apnc.report.skeleton import Plant, in_ground, in_trunk, leg_chains, trunk_corners
from apnc.report.theme import leg_colours
from apnc_core.types import Array
from apnc_plant.ground import Ground
from apnc_plant.robot import RobotDescription

REACH: Final = 4.5
"""How far the ground is drawn around the path [diagonals of the robot seen from above]."""

AREA: Final = 60.0
"""Largest area of uneven ground that is drawn [m²], about 1 MB of page."""

FLAT_AREA: Final = 6000.0
"""Largest area of a plane that is drawn [m²]: its lines need two points each."""

LEAST_REACH: Final = 0.3
"""How far the ground is drawn at least, as a share of ``REACH``."""

LANDMARK: Final = 0.5
"""Spacing of the straight lines that are drawn stronger, to show the progress [m]."""


def animation_data(run: Run) -> dict[str, Any]:
    """Everything the animation needs; arrays are read by ``apnc.array`` of the page.

    Some arrays have an entry for each shown sample. ``position``, ``rpy`` and ``focus`` (what the
    camera looks at) have the shape (3,), in the world frame. ``chains`` has the shape (n, 3, 3):
    second hip joint, knee and foot of every leg in the frame of the trunk, in which their range is
    small. ``force`` has the shape (n, 3), and ``stance`` n bytes. ``hips`` (n, 3) and ``corners``
    (8, 3) stand still in the frame of the trunk. ``ground`` and ``landmarks`` are points of lines
    in the world frame, with NaN between two lines.
    """
    record, at, plant = run.record, run.samples.at, run.shown
    ground, opens = record.experiment.ground, run.samples.opens_at
    still, chains = still_parts(record.robot, plant)
    reach = reach_of(still, chains)
    arrays = {
        "chains": chains[:, :, 1:],
        "force": plant["foot_force"],
        **ground_lines(ground, plant["position"], reach),
    }
    exact = {
        "position": plant["position"],
        "rpy": plant["rpy"],
        "focus": metrics.smooth(record.signals["position"])[at],
        **still,
    }
    return {
        "count": len(at),
        "opensAt": 0 if opens is None else int(np.searchsorted(at, opens)),
        "stance": packed(run.standing[at], "u1"),
        **fixed_data(record.robot, record.mass, ground, reach),
        "arrays": {name: Signal(values) for name, values in arrays.items()}
        | {name: Signal(values, exact=True) for name, values in exact.items()},
    }


def still_parts(robot: RobotDescription, plant: Plant) -> tuple[dict[str, Array], Array]:
    """What stands still in the frame of the trunk, and the chains of the legs in it.

    Args:
        robot: the robot.
        plant: its signals, each with the shape (T, ...).

    Returns:
        ``hips`` (n, 3) and ``corners`` (8, 3) of the trunk [m]; and the joints of every leg,
        shape (T, n, 4, 3) [m].
    """
    chains = in_trunk(plant, leg_chains(robot, plant))
    corners = in_trunk(plant, trunk_corners(robot, plant))
    return {"hips": chains[0, :, 0], "corners": corners[0]}, chains


def reach_of(still: Mapping[str, Array], chains: Array) -> float:
    """How far the ground is drawn around the robot [m]; arguments are those of still_parts."""
    outline = np.concatenate([still["corners"], chains[0, :, -1]])
    return REACH * float(np.linalg.norm(np.ptp(outline, axis=0)[:2]))


def fixed_data(
    robot: RobotDescription, mass: float, ground: Ground, reach: float
) -> dict[str, Any]:
    """What the animation needs to know once, without arrays.

    Args:
        robot: the robot.
        mass: of the robot with its payload [kg].
        ground: the ground.
        reach: how far it is drawn [m].
    """
    legs = [leg.name for leg in robot.legs]
    return {
        "legs": legs,
        "colours": list(leg_colours(legs).values()),
        "weight": mass * metrics.GRAVITY,
        "reach": reach,
        "radius": robot.contact.foot_radius,
        "normal": ground.rotation()[:, 2].tolist(),
        "look": LOOK,
    }


def ground_lines(ground: Ground, position: Array, reach: float) -> dict[str, Array]:
    """Lines of the ground around a path, as points in the world with NaN between two lines.

    Args:
        ground: the ground.
        position: of the trunk in the world [m], shape (T, 3).
        reach: how far the ground is drawn around it [m].

    Returns:
        ``ground`` and, of lines that are drawn stronger, ``landmarks``.
    """
    lines = _lines(ground, in_ground(ground, position) * [1.0, 1.0, 0.0], reach)
    return {
        "ground": _joined(ground, [points for points in lines if not _is_landmark(points)]),
        "landmarks": _joined(ground, [points for points in lines if _is_landmark(points)]),
    }


def _lines(ground: Ground, path: Array, reach: float) -> list[Array]:
    """Lines of the ground around the path, in the ground's frame.

    Of a large area they reach less far; if that is not enough, they lie around the end of the path.
    """
    largest, least = (FLAT_AREA if ground.flat else AREA), reach * LEAST_REACH
    while _area(path, reach) > largest and reach > least:
        reach = max(least, 0.8 * reach)
    while _area(path, reach) > largest and len(path) > 1:
        path = path[len(path) // 2 :]
    low, high = _corners(path, reach)
    return ground.lines(low[0], high[0], low[1], high[1])


def _corners(path: Array, reach: float) -> tuple[Array, Array]:
    return path[:, :2].min(axis=0) - reach, path[:, :2].max(axis=0) + reach


def _area(path: Array, reach: float) -> float:
    low, high = _corners(path, reach)
    return float(np.prod(high - low))


def _is_landmark(points: Array) -> bool:
    steps = points[0, :2] / LANDMARK
    straight = np.ptp(points[:, :2], axis=0) == 0.0
    return bool((straight & (np.abs(steps - np.round(steps)) < 1e-9)).any())


def _joined(ground: Ground, lines: list[Array]) -> Array:
    gap = np.full((1, 3), np.nan)
    return np.concatenate([gap, *(part for points in lines for part in (points, gap))]) @ (
        ground.rotation().T
    )
