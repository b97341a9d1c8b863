"""The schedules of commands of Fig. 13 and 14."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

from apnc.loop.experiment import Experiment
from apnc.loop.schedule import Steps
from apnc.studies.study import SCHEDULE_MI

SPEEDS: Final[Steps[float]] = ((0.0, SCHEDULE_MI), (25.0, 0.4), (40.0, SCHEDULE_MI))
"""Start [s] and MI of every interval of the schedule of Fig. 13."""

TURNS: Final[Steps[float]] = ((0.0, 0.0), (20.0, -1.0), (35.0, 1.0), (50.0, 0.0))
"""Start [s] and steering of every interval of the schedule of Fig. 14. Positive is to the left."""

SPEED, YAW_RATE = "speed_section", "yaw_rate_section"
"""Start of the names of the measures of an interval. Its number follows, from 1."""

SLOPES: Final = {f"slopes x {factor:g}": factor for factor in (0.6, 0.8, 1.0, 1.2, 1.4)}
"""Factor on both slopes of the motor neurons in straight walks, by name of the walk."""

SLOPES_S: Final = 25.0
"""Length of the straight walks [s]."""


def experiment(schedule: str, **fields: Any) -> Experiment:
    """A walk along a schedule, or a straight walk with other slopes."""
    walk = Experiment(mi=SCHEDULE_MI, duration=60.0, **fields)
    if schedule == "speeds":
        return replace(walk, mi=SPEEDS)
    if schedule == "turns":
        return replace(walk, turn=TURNS)
    own = walk.parameters()
    slopes = {name: SLOPES[schedule] * float(own[name]) for name in ("a1", "a2")}  # type: ignore[arg-type]  # plain numbers
    return replace(walk, settings=slopes, duration=SLOPES_S)
