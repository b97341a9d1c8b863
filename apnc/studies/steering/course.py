"""The courses of Fig. 13 and 14: commands over time, and what they are measured by."""

from __future__ import annotations

from typing import Final

from apnc.loop.experiment import Experiment
from apnc.loop.steps import Steps
from apnc.studies.study import COURSE_MI

SPEEDS: Final[Steps[float]] = ((0.0, COURSE_MI), (25.0, 0.4), (40.0, COURSE_MI))
"""Start [s] and MI of every section of the course of Fig. 13."""

TURNS: Final[Steps[float]] = ((0.0, 0.0), (20.0, -1.0), (35.0, 1.0), (50.0, 0.0))
"""Start [s] and steering of every section of the course of Fig. 14; positive turns left."""

SPEED, YAW_RATE = "speed_section", "yaw_rate_section"


def experiment(method: str, seed: int, course: str) -> Experiment:
    """A walk along a course."""
    mi, turn = (SPEEDS, 0.0) if course == "speeds" else (COURSE_MI, TURNS)
    return Experiment(method=method, seed=seed, mi=mi, turn=turn, duration=60.0)
