"""What the animation draws, packed for the browser: ground, legs, trunk, forces, contacts."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.report.encoding import packed
from apnc.report.panels import Array, Run
from apnc.report.skeleton import in_ground, leg_chains
from exudyn_models.ground import Surface

MARGIN: Final = 1.3
"""Width of the ground that is drawn around the path [m]."""

AREA: Final = 60.0
"""Ground that is drawn at most [m²], that of the end of the path: 2 MB."""

LANDMARK: Final = 0.5
"""Straight lines at multiples of this are drawn stronger and show the progress [m]."""


def animation_data(run: Run) -> dict[str, Any]:
    """Everything the animation needs, arrays in base64.

    Keys with one entry per shown sample: ``position``, ``rpy``, ``focus`` (what the camera looks
    at) and ``track`` (the trunk, on the ground) of 3, ``chains`` of (n, 4, 3), ``force`` of (n, 3),
    all 32-bit floats; ``stance`` of n bytes. ``ground`` and ``landmarks`` are points of lines, with
    NaN between two lines. Everything is in the world frame.
    """
    record, at, ground = run.record, run.samples.at, run.record.experiment.ground
    plant, body = record.plant, record.robot.trunk.body
    on_plane = in_ground(ground, plant["position"]) * [1.0, 1.0, 0.0]
    lines = _lines(ground, on_plane[at])
    landmarks = [_is_landmark(points) for points in lines]
    return {
        "legs": list(record.legs),
        "colours": list(run.colours.values()),
        "count": len(at),
        "opensAt": run.samples.opens_at and int(np.searchsorted(at, run.samples.opens_at)),
        "weight": record.mass * metrics.GRAVITY,
        "trunk": list(body.size),
        "trunkCenter": list(record.robot.trunk.center),
        "radius": record.robot.contact.foot_radius,
        "normal": ground.rotation()[:, 2].tolist(),
        "position": packed(plant["position"][at], "<f4"),
        "rpy": packed(plant["rpy"][at], "<f4"),
        "focus": packed(metrics.smooth(plant["position"])[at], "<f4"),
        "track": packed(on_plane[at] @ ground.rotation().T, "<f4"),
        "chains": packed(leg_chains(record.robot, plant, at), "<f4"),
        "force": packed(plant["foot_force"][at], "<f4"),
        "stance": packed(metrics.stance(plant["foot_force"][..., 2])[at], "u1"),
        "ground": _in_world(ground, [p for p, mark in zip(lines, landmarks, strict=True) if not mark]),
        "landmarks": _in_world(ground, [p for p, mark in zip(lines, landmarks, strict=True) if mark]),
    }


def _lines(ground: Surface, path: Array) -> list[Array]:
    """Lines of the ground around the path, or its end, in the frame of the ground."""
    while True:
        low, high = path[:, :2].min(axis=0) - MARGIN, path[:, :2].max(axis=0) + MARGIN
        if np.prod(high - low) <= AREA or len(path) == 1:
            return ground.lines(low[0], high[0], low[1], high[1])
        path = path[(len(path) + 1) // 2 :]


def _is_landmark(points: Array) -> bool:
    steps = points[0, :2] / LANDMARK
    straight = np.ptp(points[:, :2], axis=0) == 0.0
    return bool((straight & (np.abs(steps - np.round(steps)) < 1e-9)).any())


def _in_world(ground: Surface, lines: list[Array]) -> str:
    gap = np.full((1, 3), np.nan)
    parts = [part for points in lines for part in (points @ ground.rotation().T, gap)]
    return packed(np.concatenate([gap, *parts]), "<f4")
