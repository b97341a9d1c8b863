"""Section 3.1.4, Fig. 8: how fast the robot walks with leg RF held still."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from apnc.loop.experiment import Experiment
from apnc.report.figure import Figure
from apnc.studies.claims import Claim, Finding, verdict
from apnc.studies.plots import side_by_side, style
from apnc.studies.rows import SPEED, Row, methods_in, values
from apnc.studies.statistics import median
from apnc.studies.study import BASELINES, COURSE_MI, WALK_S, Study


def fastest(rows: Sequence[Row]) -> Finding:
    """The median speed of APNC is above that of every baseline; above one of them is 'partly'."""
    own, *others = (median(values(rows, SPEED, method=method)) for method in BASELINES)
    beaten = sum(own.size > 0 and (o.size == 0 or own.value > o.value) for o in others)
    texts = (f"{m}: {s.text(3, 'm/s')}" for m, s in zip(BASELINES, (own, *others), strict=True))
    return Finding("; ".join(texts), verdict(beaten == len(others), beaten > 0))


def figures(rows: Sequence[Row]) -> list[Figure]:
    """Speed of every method."""
    groups = {style(m)[0]: values(rows, SPEED, method=m) for m in methods_in(rows)}
    note = "Commands of leg RF held at 0."
    return [side_by_side("damage-speed", "Speed", note, "speed [m/s]", groups)]


CLAIM: Final = "with a damaged leg APNC walks fastest"

STUDY: Final = Study(
    "damage",
    partial(Experiment, mi=COURSE_MI, conditions="C3", duration=WALK_S),
    claims=(Claim("3.1.4, Fig. 8", CLAIM, fastest, BASELINES),),
    figures=figures,
)
