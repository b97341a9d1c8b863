"""The courses of Fig. 13 and 14: commands over time, and what they are measured by."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

from apnc.loop.experiment import Experiment
from apnc.loop.steps import Steps
from apnc.studies.study import COURSE_MI

SPEEDS: Final[Steps[float]] = ((0.0, COURSE_MI), (25.0, 0.4), (40.0, COURSE_MI))
"""Start [s] and MI of every section of the course of Fig. 13."""

TURNS: Final[Steps[float]] = ((0.0, 0.0), (20.0, -1.0), (35.0, 1.0), (50.0, 0.0))
"""Start [s] and steering of every section of the course of Fig. 14; positive turns left."""

SPEED, YAW_RATE = "speed_section", "yaw_rate_section"


SLOPES: Final = {f"slopes x {factor:g}": factor for factor in (0.6, 0.8, 1.0, 1.2, 1.4)}
"""Factor on both slopes of the motor neurons, by course: straight walks."""

SLOPES_S: Final = 25.0
"""Length of these walks [s]."""


def experiment(course: str, **fields: Any) -> Experiment:
    """A walk along a course."""
    walk = Experiment(mi=COURSE_MI, duration=60.0, **fields)
    if course == "speeds":
        return replace(walk, mi=SPEEDS)
    if course == "turns":
        return replace(walk, turn=TURNS)
    own = walk.parameters()
    slopes = {name: SLOPES[course] * float(own[name]) for name in ("a1", "a2")}  # type: ignore[arg-type]  # plain numbers
    return replace(walk, settings=slopes, duration=SLOPES_S)
