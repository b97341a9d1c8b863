"""Section 3.1.2: the gait at low and high update rates of the controller."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from apnc.controllers import ALL, BASELINES, TEGOTAE
from apnc.loop.experiment import Experiment
from apnc.studies.claims import (
    Claim,
    Judgement,
    Rule,
    always,
    both_criteria,
    each_of,
    faster,
    time_trend,
    trend,
    verdict,
)
from apnc.studies.plots import convergence
from apnc.studies.registry import STUDIES
from apnc.studies.results import Result, successes
from apnc.studies.statistics import rate
from apnc.studies.study import WALK_MI, Study, fewer_of_others

RATES: Final = (5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 45.0, 60.0)
OTHERS_RATES: Final = (5.0, 15.0, 25.0, 30.0, 60.0)
"""Rates [Hz] at which the baselines walk, with half of the seeds."""


def only_above(limit: float, controllers: Sequence[str]) -> Rule:
    """Rule: every trial of these controllers forms the gait above a rate [Hz], not all up to it."""

    def check(results: Sequence[Result], column: str) -> Judgement:
        low = [result for result in results if result["rate"] <= limit]
        high = [result for result in results if result["rate"] > limit]

        def of(controller: str) -> Judgement:
            below, above = (rate(successes(r, column, controller=controller)) for r in (low, high))
            text = f"{below} up to {limit:g} Hz, {above} above"
            return Judgement(text, verdict(above.value == 1.0 and below.value < 1.0, False))

        return each_of(controllers, of)

    return both_criteria(check)


CLAIMS: Final = (
    Claim("3.1.2, Fig. 5", "a higher update rate converges sooner, in all methods",
          time_trend("rate", -1, ALL), ALL),
    Claim("3.1.2, Fig. 5", "APNC succeeds in every trial at every rate", always("apnc")),
    Claim("3.1.2, Fig. 5", "Tegotae and phase resetting always succeed only above 25 Hz",
          only_above(25.0, BASELINES), BASELINES),
    Claim("3.1.2, Fig. 5", "APNC converges faster than Tegotae at every rate",
          faster([("apnc", other) for other in TEGOTAE], "rate"), ("apnc", *TEGOTAE)),
    Claim("3.3", "a higher update rate walks faster", trend("late_speed_m_per_s", "rate", 1)),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["rate"],
    partial(Experiment, mi=WALK_MI, duration=60.0),
    {"rate": RATES},
    seeds=fewer_of_others(rate=OTHERS_RATES),
    claims=CLAIMS,
    figures=lambda results: convergence(results, ("rate", "update rate [Hz]")),
)
