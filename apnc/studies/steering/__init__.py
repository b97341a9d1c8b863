"""Section 3.3: speed follows MI, and the robot turns where it is told to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from apnc.loop.record import Record
from apnc.loop.steps import steps_of
from apnc.studies.claims import NO, Claim, Finding, verdict
from apnc.studies.rows import Row, values
from apnc.studies.statistics import median
from apnc.studies.steering.course import SPEED, YAW_RATE, experiment
from apnc.studies.steering.figures import figures, scenes
from apnc.studies.study import Study

SETTLING: Final = 5.0
"""Time from the start of a section that does not count: the robot follows a new command [s]."""


def measure(record: Record) -> Row:
    """Yaw rate [rad/s] in every section of the course of turns, else speed [m/s].

    The mean over a section after its settling; None for one that the robot did not walk to its end.
    """
    turning = isinstance(record.experiment.turn, tuple)
    steps = steps_of(record.experiment.turn if turning else record.experiment.mi)
    starts = [start for start, _ in steps]
    yaw, place = np.unwrap(record.plant["rpy"][:, 2]), record.plant["position"][:, :2]
    found: Row = {}
    for i, end in enumerate([*starts[1:], record.experiment.duration]):
        begin, name = starts[i] + SETTLING, f"{YAW_RATE if turning else SPEED}_{i + 1}"
        inside = np.flatnonzero((record.time >= begin) & (record.time < end))
        if len(inside) < 2 or record.ended_at < end:
            found[name] = None
            continue
        first, last = inside[[0, -1]]
        way = yaw[last] - yaw[first] if turning else np.linalg.norm(place[last] - place[first])
        found[name] = float(way / (end - begin))
    return found


def speed_steps(rows: Sequence[Row]) -> Finding:
    """Speed doubles within a fifth with the step of MI, and comes back within 15 %."""
    low, high, again = (median(values(rows, f"{SPEED}_{i}")) for i in (1, 2, 3))
    text = f"{low.text(3)}, {high.text(3)}, {again.text(3, 'm/s')}"
    if not (low.size and high.size and again.size):
        return Finding(text, NO)
    doubled = 1.6 <= high.value / low.value <= 2.4
    back = abs(again.value / low.value - 1.0) <= 0.15
    return Finding(text, verdict(doubled and back, high.value > low.value))


def turns(rows: Sequence[Row]) -> Finding:
    """The intervals of the yaw rate are below 0 to the right and above 0 to the left."""
    right, left = (median(values(rows, f"{YAW_RATE}_{i}")) for i in (2, 3))
    text = f"right {right.text(2)}, left {left.text(2, 'rad/s')}"
    # without a number every comparison is false
    return Finding(text, verdict(right.high < 0.0 < left.low, right.value < left.value))


CLAIMS: Final = (
    Claim("3.3, Fig. 13", "MI 0.15, 0.4, 0.15: from about 0.08 to 0.16 m/s and back", speed_steps),
    Claim("3.3, Fig. 14", "steeper slopes on one side turn the robot to the other", turns),
)

STUDY: Final = Study(
    "steering",
    experiment,
    {"course": ("speeds", "turns")},
    methods=("apnc",),
    measure=measure,
    claims=CLAIMS,
    figures=figures,
    scenes=scenes,
)
