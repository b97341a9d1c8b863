"""What does each departure from the paper buy? Each is taken back alone, and the walk is judged."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies.results import Result, matching, successes, values
from apnc.studies.states.measure import STOPPED
from apnc.studies.states.measure import measure as judged
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.study import SCHEDULE_MI, WALK_MI, Study
from apnc.studies.table import markdown, middle
from apnc_core.schema import Causality
from apnc_core.settings import SettingLike
from apnc_core.variables import variables_of as variables
from apnc_plant.robot import RobotDescription, load_robot
from research.command import main
from research.registry import STUDIES

PRINTED: Final[Mapping[str, SettingLike]] = {
    v.name: v.paper
    for v in variables(Causality.parameter)
    if v.paper is not None and v.paper != v.start
}
"""Parameters that differ from the paper or the authors' code."""

ADDED: Final[Mapping[str, SettingLike]] = {"kappa_hold": 1}
"""Parameters that the paper does not have, at the value at which they do nothing."""

NONE: Final = "none"
POSE: Final = "femur_angle, tibia_angle"
PUBLISHED_POSE: Final = (43.0, 92.0)
"""Reference pose of the authors' robot data, the same for every leg [deg]."""

REMOVED: Final[Mapping[str, Mapping[str, SettingLike]]] = {
    NONE: {},
    POSE: {},
    **{name: {name: value} for name, value in {**PRINTED, **ADDED}.items()},
}
"""Parameters as printed, by the departure that is taken back. ``POSE`` is one of the robot."""

WALKS: Final[Mapping[str, Mapping[str, Any]]] = {
    "MI 0.04": {"mi": 0.04},
    "MI 0.08": {"mi": 0.08},
    "MI 0.15": {"mi": 0.15},
    "MI 0.28": {"mi": 0.28},
    "MI 0.4": {"mi": 0.4},
    "C4": {"mi": WALK_MI, "conditions": "C4"},
    "C3": {"mi": SCHEDULE_MI, "conditions": "C3"},
}
"""Fields of the experiment by name of the walk."""

STATES: Final = "S1 to S3"
STOP_MOVES: Final = "moves_at_mi_zero"
WALK_S: Final = 25.0
"""Length of the walks [s]."""


def experiment(controller: str, seed: int, removed: str, task: str) -> Experiment:
    """A walk, or the run through the states S1 to S3, with one departure taken back."""
    own: dict[str, Any] = {"settings": REMOVED[removed]}
    if removed == POSE:
        own["robot"] = posed(load_robot("lilibot"))
    if task == STATES:
        return TIMELINE.experiment(controller, seed, **own)
    return Experiment(duration=WALK_S, controller=controller, seed=seed, **own, **WALKS[task])


def posed(robot: RobotDescription) -> RobotDescription:
    """The robot with the published reference pose."""
    femur, tibia = map(math.radians, PUBLISHED_POSE)
    legs = (replace(leg, femur_angle=femur, tibia_angle=tibia) for leg in robot.legs)
    return replace(robot, legs=tuple(legs))


def measure(record: Record) -> Result:
    """Figures of the states S1 to S3, for the run through them.

    Returns:
        The figures of the study ``states``, and ``moves_at_mi_zero``: whether an oscillator moves
        in the last second of MI = 0. Nothing for a walk.
    """
    if not isinstance(record.experiment.mi, tuple):
        return {}
    time, o1 = record.time, record.signals["o1"]
    late = o1[(time >= TIMELINE.restarted - 1.0) & (time < TIMELINE.restarted)]
    moves = bool((np.ptp(late, axis=0) >= STOPPED).any()) if len(late) else None
    return judged(record) | {STOP_MOVES: moves}


def table(results: Sequence[Result]) -> str:
    """A line per departure: runs that form the strict trot, speed, and runs through S1 to S3."""
    return markdown(
        _line(removed, matching(results, removed=removed)) for removed in _in_order(results)
    )


def _in_order(results: Sequence[Result]) -> list[str]:
    return list(dict.fromkeys(result["removed"] for result in results))


def _line(removed: str, results: Sequence[Result]) -> dict[str, str]:
    entries = {"as printed": _words(removed)}
    for task in WALKS:
        hits = successes(matching(results, task=task))
        entries[f"trot, {task}"] = f"{sum(hits)}/{len(hits)}"
    speeds = values(matching(results, task="MI 0.15"), "late_speed_m_per_s")
    entries["speed at MI 0.15 [m/s]"] = middle(speeds, 3)
    runs = matching(results, task=STATES)
    for state in ("S1", "S2", "S3"):
        entries[state] = f"{sum(bool(run.get(f'state_{state}')) for run in runs)}/{len(runs)}"
    stops = [run.get(STOP_MOVES) is False for run in runs]
    entries["stops at MI = 0"] = f"{sum(stops)}/{len(stops)}"
    return entries


def _words(removed: str) -> str:
    if removed == POSE:
        return f"{POSE} = {', '.join(f'{angle:g}' for angle in PUBLISHED_POSE)} deg"
    names = REMOVED[removed]
    return ", ".join(f"{n} = {getattr(v, 'name', v)}" for n, v in names.items()) or NONE


STUDY: Final = Study(
    STUDIES["departures"],
    experiment,
    {"removed": tuple(REMOVED), "task": (*WALKS, STATES)},
    controllers=("apnc",),
    measure=measure,
    table=table,
)

if __name__ == "__main__":
    main(STUDY.name)
