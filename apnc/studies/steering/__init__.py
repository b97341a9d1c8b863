"""Section 3.3: speed follows MI, and the robot turns where it is told to."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from apnc import metrics
from apnc.loop.record import Record
from apnc.loop.schedule import steps_of
from apnc.studies.claims import FEW, NO, PARTLY, YES, Claim, Judgement, ranks, verdict
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import Result, cells_in, matching, values
from apnc.studies.statistics import median
from apnc.studies.steering.figures import figures, scenes
from apnc.studies.steering.schedules import SLOPES, SPEED, YAW_RATE, experiment
from apnc.studies.study import Study

SETTLING: Final = 5.0
"""Time at the start of an interval that does not count. The robot takes up a new command [s]."""


def measure(record: Record) -> Result:
    """Mean yaw rate or speed in every interval of a schedule.

    Returns:
        ``yaw_rate_section_N`` [rad/s] of interval N for the schedule of turns, otherwise
        ``speed_section_N``, the speed along the heading [m/s]. The first 5 s of an interval do not
        count. None for an interval that the robot did not walk to its end.
    """
    turning = isinstance(record.experiment.turn, tuple)
    steps = steps_of(record.experiment.turn if turning else record.experiment.mi)
    starts = [start for start, _ in steps]
    yaw = np.unwrap(record.signals["rpy"][:, 2])
    position = record.signals["position"]
    found: Result = {}
    for i, end in enumerate([*starts[1:], record.experiment.duration]):
        begin, name = starts[i] + SETTLING, f"{YAW_RATE if turning else SPEED}_{i + 1}"
        inside = np.flatnonzero((record.time >= begin) & (record.time < end))
        if len(inside) < 2 or record.ended_at < end:
            found[name] = None
            continue
        if turning:
            figure = (yaw[inside[-1]] - yaw[inside[0]]) / (end - begin)
        else:
            figure = metrics.smoothed_speed(
                record.time[inside], position[inside], yaw[inside]
            ).mean()
        found[name] = float(figure)
    return found


def speed_steps(results: Sequence[Result]) -> Judgement:
    """The step of MI doubles the speed, within a fifth, and the speed returns within 15 %.

    Faster at the higher MI is partly.
    """
    runs = matching(results, schedule="speeds")
    low, high, again = (median(values(runs, f"{SPEED}_{i}")) for i in (1, 2, 3))
    text = ", ".join(each.text(3, "m/s", len(runs)) for each in (low, high, again))
    if min(low.size, high.size, again.size) < MIN_SEEDS:
        return Judgement(text, FEW)
    doubled = 1.6 <= high.value / low.value <= 2.4
    back = abs(again.value / low.value - 1.0) <= 0.15
    return Judgement(text, verdict(doubled and back, high.value > low.value))


def turns(results: Sequence[Result]) -> Judgement:
    """The 95 % intervals of the yaw rate are below 0 to the right and above 0 to the left.

    A smaller median to the right than to the left is partly.
    """
    runs = matching(results, schedule="turns")
    right, left = (median(values(runs, f"{YAW_RATE}_{i}")) for i in (2, 3))
    text = f"right {right.text(2, 'rad/s', len(runs))}, left {left.text(2, 'rad/s', len(runs))}"
    if min(right.size, left.size) < MIN_SEEDS:
        return Judgement(text, FEW)
    return Judgement(text, verdict(right.high < 0.0 < left.low, right.value < left.value))


def slopes_speed(results: Sequence[Result]) -> Judgement:
    """Speed rises with the slopes, see ``ranks``. Only up to the robot's own slopes is partly."""
    runs = [
        {**result, "slopes": SLOPES[result["schedule"]]}
        for result in results
        if result.get("schedule") in SLOPES
    ]
    column = f"{SPEED}_1"
    text = ", ".join(
        f"{median(values(runs, column, slopes=x)).text(3, 'm/s')} at {x:g}"
        for x in cells_in(runs, "slopes")
    )
    every = ranks(runs, column, "slopes", 1, ("apnc",))
    lower = ranks([r for r in runs if r["slopes"] <= 1.0], column, "slopes", 1, ("apnc",))
    found = PARTLY if (every.verdict, lower.verdict) == (NO, YES) else every.verdict
    return Judgement(f"{every.measured}; {text}", found)


CLAIMS: Final = (
    Claim("3.3, Fig. 13", "MI 0.15, 0.4, 0.15: from about 0.08 to 0.16 m/s and back", speed_steps),
    Claim("3.3", "steeper slopes of the motor neurons walk faster", slopes_speed),
    Claim("3.3, Fig. 14", "steeper slopes on one side turn the robot to the other", turns),
)

STUDY: Final = Study(
    STUDIES["steering"],
    experiment,
    {"schedule": ("speeds", "turns", *SLOPES)},
    controllers=("apnc",),
    seeds=lambda cell, trials: math.ceil(trials / 2) if cell["schedule"] in SLOPES else trials,
    measure=measure,
    claims=CLAIMS,
    figures=figures,
    scenes=scenes,
)
