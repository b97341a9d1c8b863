"""A tuned robot with made-up runs, for pages and tables."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from apnc.tune import Cell, Tuned, Validation
from apnc.tune.design import Candidate
from apnc.tune.measured import Measured
from apnc.tune.search import Best, Count
from apnc.tune.tuned_file import read_back, tuned_text
from apnc_core.interface import Parameters
from apnc_plant.robot import RobotDescription, load_robot

MI = (0.08, 0.11, 0.15, 0.21, 0.28)

WALK = Measured(
    kind="walk", share=0.5, fell=1.0, strict=True, time=2.0, mean_error=0.2, end_error=0.0,
    speed=0.12, lift=0.07, slip=0.1, feet=0.1, turning=0.0, saturated=0.0, transport=1.0,
)  # fmt: skip
FALLEN = replace(
    WALK, fell=0.3, strict=False, time=float("nan"), mean_error=np.pi, end_error=1.5, speed=0.0,
    lift=0.0, slip=1.0, feet=4.0,
)  # fmt: skip


def validation(bad: dict[tuple[str, int], int] | None = None, seeds: int = 4) -> Validation:
    """All aims reached, but for runs that fell.

    Args:
        bad: how many runs fell, by kind and index of MI.
        seeds: number of runs in a cell.
    """
    cells = []
    for kind in ("walk", "apc", "varied", "payload", "sensor", "air"):
        for k, mi in enumerate(MI) if kind in ("walk", "apc", "varied") else [(2, MI[2])]:
            fell = (bad or {}).get((kind, k), 0)
            walks = replace(WALK, kind=kind, share=k / 4, speed=0.1 + 0.01 * k)
            runs = [replace(FALLEN, kind=kind)] * fell + [walks] * (seeds - fell)
            cells.append(Cell(kind, mi, tuple(runs)))
    return Validation(tuple(cells), 0.155, 1.233, 1.0, "trot")


def tuned(found: Validation | None = None, before: RobotDescription | None = None) -> Tuned:
    """Lilibot, or another robot, with another slope of its hips, and that of its knees written."""
    before = before or load_robot("lilibot")
    own = {"a1": 0.2, "a2": Parameters().a2}
    changed: dict[str, Any] = {"controller": {**before.controller, **own}, "mi": 0.13}
    robot = replace(before, mi_range=(0.08, 0.28), rate=60.0, **changed)
    if before == load_robot("lilibot"):
        robot = read_back(tuned_text("lilibot", robot, []))
    runs = tuple(replace(WALK, share=k / 10) for k in range(11))
    best = Best((0.5,), Candidate(robot, {}), runs, 1.0)
    count = Count(2, 32, 5000.0, 60.0)
    return Tuned(
        "", robot, before, best, (0.4,), count, found, "apnc tune lilibot --candidates 32 --seed 1"
    )
