"""The paper's other experiments as runs of a search: update rates, states S1 to S3, damage, turns.

``apnc tune --paper`` adds them, for a robot that is to repeat the paper and not only to walk.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.tune.design import Candidate, Start
from apnc.tune.measured import Measured, fallen, measured, target
from apnc.tune.runs import Task, shared_step
from apnc_core.types import Array
from apnc_plant.conditions import ALL, Conditions
from apnc_plant.robot import RobotDescription

MI_OF_RATES: Final = 0.08
"""MI of the study of update rates (Fig. 5)."""

RATES: Final[Mapping[float, float]] = {
    10.0: 45.0, 15.0: 36.0, 20.0: 30.0, 25.0: 26.0, 30.0: 24.0, 45.0: 20.0,
}  # fmt: skip
"""Update rates of Fig. 5 below the usual 60 Hz, each with the length of its run [s]."""

MI_OF_STATES: Final = 0.15
"""MI of the states S1 to S3, of damage and of turns."""

PAYLOAD: Final = 0.5
"""Payload of condition C4, as a share of the mass [1]."""

BROKEN_S, STOPPED_S, RESTARTED_S, END_S = 3.0, 8.0, 9.0, 17.0
"""When front sensors stick (S2), MI is 0 and all sensors are silent, MI returns (S3), the end."""

STUCK: Final = 0.9
"""What the front sensors report in S2, in halves of the weight [1]."""

INEXACT: Final = (0.16, -0.09, 0.12, -0.05, 0.1, -0.12, 0.08)
"""How far a stored gait is from the exact one [rad]: one that was measured is never exact."""

TURNS: Final = ((0.0, 0.0), (3.0, 0.5), (7.5, -0.5))
"""Steering over time [s]."""

TURNS_S: Final = 12.0
"""Length of a run with steering [s]."""

WANTED_TURN: Final = 0.29
"""Turning rate at half steering without cost [rad/s]: the aim of 0.25 and a margin."""

WANTED_RATIO: Final = 1.95
"""Speed at MI 0.40 over that at MI 0.15 without cost [1]; the paper has 2."""

SLOW: Final = 0.05
"""Speed below which a robot with a broken part or a load is too slow [sqrt(g L)]."""

DAMAGE_S: Final = 20.0
"""Length of a run with a damaged leg [s]."""


def of_paper(
    start: Start, each: Candidate, bodies: Sequence[RobotDescription], number: int
) -> list[Task]:
    """Runs of a candidate in a generation.

    Args:
        start: what is tuned.
        each: the candidate.
        bodies: bodies of the generation; its runs take them in turn.
        number: of the generation; it chooses the update rates.
    """
    legs = [leg.name for leg in start.robot.legs]
    front = {legs[0]: STUCK, legs[len(legs) // 2]: STUCK}
    gait = tuple((target(len(legs)) + np.array(INEXACT[: len(legs) - 1])).tolist())
    stored: dict[str, Any] = {"stored": True, "phi_stored": gait}
    rates = list(RATES)
    chosen = rates[number % len(rates)], rates[(number + 3) % len(rates)]
    states = (
        (0.0, Conditions()),
        (BROKEN_S, Conditions(stuck=front)),
        (STOPPED_S, Conditions(dropout=(ALL,))),
    )
    stops = ((0.0, MI_OF_STATES), (STOPPED_S, 0.0), (RESTARTED_S, MI_OF_STATES))
    loaded = Conditions(payload=PAYLOAD * start.robot.mass)
    plan: list[tuple[str, dict[str, Any]]] = [
        *(
            ("rate", {"mi": MI_OF_RATES, "rate": rate, "duration": RATES[rate]})
            for rate in chosen
        ),
        ("load", {"mi": MI_OF_RATES, "conditions": loaded, "duration": DAMAGE_S}),
        (
            "damage",
            {"mi": MI_OF_STATES, "conditions": Conditions(damaged=(legs[0],)),
             "duration": DAMAGE_S},
        ),
        ("states", {"mi": stops, "conditions": states, "duration": END_S, "settings": stored}),
        ("turns", {"mi": MI_OF_STATES, "turn": TURNS, "duration": TURNS_S, "settings": stored}),
    ]  # fmt: skip
    return [
        Task(kind, 0.5, _experiment(start, each, bodies[k % len(bodies)], number + k, fields))
        for k, (kind, fields) in enumerate(plan)
    ]


def _experiment(
    start: Start, each: Candidate, body: RobotDescription, seed: int, fields: dict[str, Any]
) -> Experiment:
    """An experiment; times and the update rate, for Lilibot's size, become those of the robot."""
    settings = {"robot_weight": each.robot.weight, **fields.pop("settings", {})}
    rate = fields.pop("rate", 60.0) / start.time
    scaled: dict[str, Any] = {
        name: tuple((at * start.time, entry) for at, entry in value)
        if isinstance(value, tuple)
        else value
        for name, value in fields.items()
    }
    scaled["duration"] *= start.time
    step = shared_step(each.robot, start.rate, coarse=True)
    return Experiment(
        robot=body, seed=seed, controller="apnc", settings=settings, rate=rate, step=step,
        engine="compiled", **scaled,
    )  # fmt: skip


def measured_of_paper(start: Start, task: Task, record: Record) -> Measured:
    """Measure a run of :func:`of_paper`, or any other."""
    if task.kind not in ("states", "turns"):
        return measured(start, task, record)
    ticks = task.experiment.ticks
    if not record.complete or len(record.time) < ticks:
        return fallen(task, len(record.time) / ticks)
    whole = measured(start, task, record)
    if task.kind == "turns":
        yaw = np.unwrap(record.signals["rpy"][:, 2])
        at = [round(part * ticks / TURNS_S) - 1 for part in (4.5, 7.5, 9.0, 12.0)]
        left, right = (yaw[at[1]] - yaw[at[0]], yaw[at[2]] - yaw[at[3]])
        return replace(whole, turning=float(min(left, right)) / 3.0)
    return _in_states(start, whole, record, ticks)


def _in_states(start: Start, whole: Measured, record: Record, ticks: int) -> Measured:
    o1, o2 = record.signals["o1"], record.signals["o2"]
    ahead = metrics.smoothed_speed(
        record.time, record.signals["position"], record.signals["rpy"][:, 2]
    )

    def part(begin: float, end: float) -> slice:
        return slice(round(begin / END_S * ticks), round(end / END_S * ticks))

    s2, s3 = part(BROKEN_S + 0.5, STOPPED_S), part(RESTARTED_S + 5.0, END_S)
    errors = [_error(o1[where], o2[where]) for where in (s2, s3)]
    speeds = [float(ahead[where].mean()) / start.gravity_speed for where in (s2, s3)]
    return replace(
        whole,
        end_error=float(sum(np.clip(e - 0.25, 0.0, 1.5).mean() for e in errors)),
        strict=all(bool((e <= metrics.STRICT_TOLERANCE).all()) for e in errors),
        speed=min(speeds),
    )


def _error(o1: Array, o2: Array) -> Array:
    found = metrics.phase_error(o1, o2, target(o1.shape[1]))
    return np.asarray(np.nan_to_num(found, nan=np.pi))


def cost_of_paper(run: Measured) -> float:
    """Cost of a run of :func:`of_paper` that did not fall."""
    slow = min(1.0, max(0.0, 1.0 - run.speed / SLOW))
    match run.kind:
        case "turns":
            return min(2.0, max(0.0, 1.5 * (1.0 - run.turning / WANTED_TURN)))
        case "states":
            return run.end_error + 0.4 * (not run.strict) + slow
    late = 2.0 * min(run.mean_error / math.pi, 1.0) + 1.5 * run.end_error
    return late + 0.4 * (not run.strict) + slow


def cost_of_ratio(runs: Sequence[Measured], mi: Sequence[float]) -> float:
    """Cost of a speed that grows too little with MI.

    The speeds at MI 0.15 and 0.40 are those of a straight line through the runs.
    """
    walks = [(at, run.speed) for at, run in zip(mi, runs, strict=True) if run.kind == "walk"]
    if len(walks) < 3 or max(walks)[0] < 0.3:
        return 0.0
    at, speeds = np.array(walks).T
    slope, at_zero = np.polyfit(at, speeds, 1).tolist()
    slow, fast = (max(at_zero + slope * each, 0.02) for each in (0.15, 0.40))
    return float(1.5 * min(1.0, max(0.0, WANTED_RATIO - fast / slow)))
