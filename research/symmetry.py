"""Section 4.1.1: do the legs stay in phase if the loads under all feet are equal?

The robot is symmetric and its sensors have no noise. A seed would change nothing, so there is one
run per MI.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies.claims import FEW, Claim, Judgement, verdict
from apnc.studies.results import STRICT, Result, values
from apnc.studies.robots import symmetric
from apnc.studies.statistics import median, of_runs
from apnc.studies.study import WALK_S, Study
from apnc_plant.robot import load_robot
from research.command import main
from research.registry import STUDIES

PARTED: Final = "parted_at_s"

MIN_RUNS: Final = 3
"""Smallest number of MI for a verdict."""


def experiment(controller: str, seed: int, mi: float) -> Experiment:
    """A walk of the symmetric robot."""
    robot = symmetric(load_robot("lilibot"))
    return Experiment(robot=robot, controller=controller, seed=seed, mi=mi, duration=WALK_S)


def measure(record: Record) -> Result:
    """Time when a leg was first more than 0.6 rad from the phase of leg 1 [s], None if never."""
    o1, o2 = record.signals["o1"], record.signals["o2"]
    error = metrics.phase_error(o1, o2, (0.0,) * (len(record.legs) - 1))
    apart = record.time[error > metrics.STRICT_TOLERANCE]
    return {PARTED: float(apart[0]) if len(apart) else None}


def in_phase(results: Sequence[Result]) -> Judgement:
    """The legs stay in phase at every MI. At some of them is partly."""
    parted, trots = values(results, PARTED), values(results, STRICT)
    text = (
        f"parted after {median(parted).text(1, 's', len(results))}; "
        f"trot after {median(trots).text(1, 's', len(results))}"
    )
    together = len(results) - len(parted)
    found = verdict(together == len(results), together > 0) if len(results) >= MIN_RUNS else FEW
    return Judgement(f"together in {of_runs(together, len(results))}; {text}", found)


CLAIM: Final = "if all loads are equal the legs stay in phase and no gait forms"

STUDY: Final = Study(
    STUDIES["symmetry"],
    experiment,
    {"mi": (0.08, 0.12, 0.16, 0.2, 0.24)},
    controllers=("apnc",),
    seeds=lambda cell, trials: 1,
    measure=measure,
    claims=(Claim("4.1.1", CLAIM, in_phase, seeds=1),),
)

if __name__ == "__main__":
    main(STUDY.name)
