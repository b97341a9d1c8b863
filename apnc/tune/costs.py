"""Costs of a run, 0 for a perfect walk. Lengths count in leg lengths L, speeds in sqrt(g L)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from apnc.tune.design import Start
from apnc.tune.measured import (
    MAX_SLIP,
    MIN_LIFT,
    MIN_SPEED,
    WANTED_LIFT,
    WANTED_SLIP,
    Measured,
)
from apnc.tune.paper import cost_of_paper, cost_of_ratio
from apnc.tune.runs import GAIT_KINDS, Task

FAILED: Final = 14.0
"""Cost of a run whose robot fell at once or whose motion diverged."""

SPARED: Final = 0.3
"""What of it a run is spared whose robot falls at the end, as a share of it."""

MILD: Final = 7.0
"""Cost up to which a run that does not fall costs as much as it does badly. Above, costs grow
less and less and stay below that of any fall: a search is never paid for throwing a robot over."""


@dataclass(frozen=True)
class Weights:
    """What a gait costs that is not perfect.

    Args:
        late: of a gait that forms late [1].
        speed: without cost [sqrt(g L)]: at the lowest MI, and what is added until the highest.
        turn: of a turn [1].
        worst: of the foot that lifts least and of that which slips most with couplings, besides
            the mean over the feet [1].
        grows: whether the speed is to grow with MI as the paper's does.
    """

    late: float
    speed: tuple[float, float]
    turn: float
    worst: float = 0.0
    grows: bool = False


USUAL: Final = Weights(late=2.0, speed=(0.065, 0.08), turn=0.25)
"""For a robot that is to walk well."""

NEAR: Final = replace(USUAL, worst=2.0)
"""For one that walks already and is to reach the aims of a validation, which are of the worst
foot. At the beginning of a search these would hide what the other feet do."""

OF_PAPER: Final = Weights(late=6.0, speed=(0.045, 0.05), turn=0.5, grows=True)
"""For one that is to repeat the paper, which asks how soon and how surely a gait forms."""

WANTED_TURN: Final = math.radians(10.0) / 45.0
"""Turning rate that costs little [rad/s], in the time of a robot of Lilibot's size."""


def weights_of(start: Start) -> Weights:
    """What a gait costs in a search."""
    if start.paper:
        return OF_PAPER
    return NEAR if start.near else USUAL


def cost_of(run: Measured, weights: Weights = USUAL) -> float:
    """Cost of a run."""
    if run.fell < 1.0:
        return FAILED * (1.0 - SPARED * run.fell)
    cost = _cost_of_gait(run, weights) if run.kind in GAIT_KINDS else cost_of_paper(run)
    if cost <= MILD:
        return cost
    room = FAILED * (1.0 - SPARED) - MILD
    return MILD + room * (1.0 - math.exp((MILD - cost) / room))


def _cost_of_gait(run: Measured, weights: Weights) -> float:
    """Cost of a run that is to show the gait, and did not fall."""
    cost = weights.late * min(run.mean_error / np.pi, 1.0) + 1.5 * run.end_error
    cost += 0.4 * (not run.strict) + _cost_of_no_walk(run)
    wanted = weights.speed[0] + weights.speed[1] * run.share
    cost += 1.5 * min(1.0, max(0.0, 1.0 - run.speed / wanted))
    cost += 2.0 * run.saturated + 0.02 * run.transport
    if run.kind in ("walk", "apc"):
        cost += run.feet + weights.turn * math.log1p(abs(run.turning) / WANTED_TURN)
    if run.kind == "walk":
        worst = (1.0 - run.lift / WANTED_LIFT, run.slip / WANTED_SLIP - 1.0)
        cost += weights.worst * sum(min(1.0, max(0.0, each)) for each in worst)
    return cost


def _cost_of_no_walk(run: Measured) -> float:
    """Cost of a run that is no walk, by how far it is from one; 0 of a walk.

    It is as large as that of a gait that does not form: else a search finds robots that slide or
    creep in a perfect gait, and is not led away from them.
    """
    if run.walks:
        return 0.0
    return 1.0 + sum(
        min(1.0, max(0.0, missing))
        for missing in (
            1.0 - run.speed / MIN_SPEED,
            1.0 - run.lift / MIN_LIFT,
            run.slip / MAX_SLIP - 1.0,
        )
    )


def total(tasks: Sequence[Task], runs: Sequence[Measured], weights: Weights = USUAL) -> float:
    """Cost of a candidate: a mean over its runs, in which one large cost exceeds many small.

    Args:
        tasks: its runs.
        runs: what was measured of them.
        weights: what a gait costs.
    """
    costs = [cost_of(run, weights) for run in runs]
    mean = sum(cost + cost**2 for cost in costs) / len(costs)
    if not weights.grows:
        return mean
    return mean + cost_of_ratio(runs, [_mi(task) for task in tasks])


def _mi(task: Task) -> float:
    mi = task.experiment.mi
    return float(mi) if isinstance(mi, int | float) else math.nan
