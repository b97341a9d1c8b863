"""Section 3.1.4, Fig. 8: how fast the robot walks with the right front leg held still."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from apnc.controllers import ALL, OWN_CONTROLLER, distinct, named_controller
from apnc.loop.experiment import Experiment
from apnc.report.figure import Figure
from apnc.studies.claims import FEW, SIGNIFICANT, Claim, Judgement, verdict
from apnc.studies.plots import LOOKS, counted, side_by_side
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import SPEED, Result, controllers_in, matching, values
from apnc.studies.statistics import compare, holm, median, p_text
from apnc.studies.study import SCHEDULE_MI, WALK_S, Study, fewer_of_others

COMPARED: Final = distinct(ALL, "damage")


def fastest(results: Sequence[Result]) -> Judgement:
    """APNC is significantly faster than every baseline (Holm). Than some of them is partly.

    A baseline with fewer than ``MIN_SEEDS`` speeds does not count.
    """
    speeds = {label: values(results, SPEED, controller=label) for label in COMPARED}
    own, others = speeds[OWN_CONTROLLER], [label for label in COMPARED if label != OWN_CONTROLLER]
    told = [label for label in others if len(speeds[label]) >= MIN_SEEDS]
    tests = dict(zip(told, holm([compare(own, speeds[label]) for label in told]), strict=True))
    beaten = sum(test.p <= SIGNIFICANT and test.effect > 0 for test in tests.values())
    texts = (
        f"{named_controller(label).name}: "
        f"{median(found).text(3, 'm/s', len(matching(results, controller=label)))}"
        + (f", {p_text(tests[label].p)}" if label in tests else "")
        for label, found in speeds.items()
    )
    holds = verdict(beaten == len(told), beaten > 0)
    return Judgement("; ".join(texts), holds if told and len(own) >= MIN_SEEDS else FEW)


def figures(results: Sequence[Result]) -> list[Figure]:
    """Speeds of every controller."""
    labels = controllers_in(results)
    groups = {
        counted(results, SPEED, label): values(results, SPEED, controller=label) for label in labels
    }
    colours = [LOOKS[label].colour for label in labels]
    note = "Commands of the right front leg held at 0."
    return [side_by_side("damage-speed", "Speed", note, "speed [m/s]", groups, colours)]


CLAIM: Final = "with a damaged leg APNC walks fastest"

STUDY: Final = Study(
    STUDIES["damage"],
    partial(Experiment, mi=SCHEDULE_MI, conditions="C3", duration=WALK_S),
    controllers=COMPARED,
    seeds=fewer_of_others(),
    claims=(Claim("3.1.4, Fig. 8", CLAIM, fastest, COMPARED),),
    figures=figures,
)
