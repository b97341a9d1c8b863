"""Section 3.1.4, Fig. 8: how fast the robot walks with leg RF held still."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from apnc.loop.experiment import Experiment
from apnc.report.figure import Figure
from apnc.studies.claims import FEW, MIN_SEEDS, SIGNIFICANT, Claim, Finding, verdict
from apnc.studies.contenders import ALL, RIVALS, contender
from apnc.studies.plots import counted, side_by_side
from apnc.studies.registry import STUDIES
from apnc.studies.rows import SPEED, Row, matching, methods_in, values
from apnc.studies.statistics import compare, holm, median, p_text
from apnc.studies.study import COURSE_MI, WALK_S, Study, fewer_of_others


def fastest(rows: Sequence[Row]) -> Finding:
    """APNC is significantly faster than every baseline (Holm); than some of them is 'partly'.

    A baseline with fewer than five speeds does not count.
    """
    speeds = {label: values(rows, SPEED, method=label) for label in ALL}
    own, told = speeds["apnc"], [label for label in RIVALS if len(speeds[label]) >= MIN_SEEDS]
    tests = dict(zip(told, holm([compare(own, speeds[label]) for label in told]), strict=True))
    beaten = sum(test.p <= SIGNIFICANT and test.effect > 0 for test in tests.values())
    texts = (
        f"{contender(label).name}: "
        f"{median(found).text(3, 'm/s', len(matching(rows, method=label)))}"
        + (f", {p_text(tests[label].p)}" if label in tests else "")
        for label, found in speeds.items()
    )
    holds = verdict(beaten == len(told), beaten > 0)
    return Finding("; ".join(texts), holds if told and len(own) >= MIN_SEEDS else FEW)


def figures(rows: Sequence[Row]) -> list[Figure]:
    """Speed of every method."""
    labels = methods_in(rows)
    groups = {counted(rows, SPEED, label): values(rows, SPEED, method=label) for label in labels}
    colours = [contender(label).colour for label in labels]
    note = "Commands of leg RF held at 0."
    return [side_by_side("damage-speed", "Speed", note, "speed [m/s]", groups, colours)]


CLAIM: Final = "with a damaged leg APNC walks fastest"

STUDY: Final = Study(
    STUDIES["damage"],
    partial(Experiment, mi=COURSE_MI, conditions="C3", duration=WALK_S),
    seeds=fewer_of_others(),
    claims=(Claim("3.1.4, Fig. 8", CLAIM, fastest, ALL),),
    figures=figures,
)
