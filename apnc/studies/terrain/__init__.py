"""Section 3.1.3: the gait on ground with obstacles. Every seed has other obstacles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np

from apnc.controllers import ALL, PHASE_RESET, TEGOTAE
from apnc.loop.experiment import Experiment
from apnc.studies.claims import (
    FEW,
    SIGNIFICANT,
    Claim,
    Judgement,
    always,
    both_criteria,
    each_of,
    faster,
    time_trend,
    verdict,
)
from apnc.studies.plots import convergence
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import Result, successes, values
from apnc.studies.statistics import compare_rates, compare_spread, p_text, rate
from apnc.studies.study import WALK_MI, WALK_S, Study, fewer_of_others
from apnc_plant.ground import Obstacles
from apnc_plant.robot.size import times_longer

ROUGHNESS: Final = (0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0)
OTHERS_ROUGHNESS: Final = (0.0, 0.4, 0.8, 0.9, 1.0)
"""Roughness on which the baselines walk, with half of the seeds."""


def experiment(seed: int, roughness: float, **fields: Any) -> Experiment:
    """A walk over obstacles of the robot's size."""
    walk = Experiment(seed=seed, mi=WALK_MI, duration=WALK_S, **fields)
    scale = times_longer(walk.description)
    return replace(walk, ground=Obstacles(roughness=roughness, seed=seed, scale=scale))


def spread_grows(results: Sequence[Result], column: str) -> Judgement:
    """For every controller, the times spread significantly more above R = 0.5 than up to it."""
    smooth = [result for result in results if result["roughness"] <= 0.5]
    rough = [result for result in results if result["roughness"] > 0.5]

    def of(controller: str) -> Judgement:
        a, b = (values(part, column, controller=controller) for part in (smooth, rough))
        if min(len(a), len(b)) < MIN_SEEDS:
            return Judgement(f"too few, n = {len(a)} and {len(b)}", FEW)
        test = compare_spread(a, b)
        text = f"{np.std(a):.1f} s up to R = 0.5, {np.std(b):.1f} s above, {p_text(test.p)}"
        return Judgement(text, verdict(test.effect > 0 and test.p <= SIGNIFICANT, False))

    return each_of(ALL, of)


def fails_above(results: Sequence[Result], column: str) -> Judgement:
    """For each setting of Tegotae, every trial forms the gait up to R = 0.8, and not all above.

    Significantly fewer above is partly. No verdict for a setting that forms it in fewer than
    ``MIN_SEEDS`` trials up to 0.8, since roughness is then not what prevents it.
    """
    low = [result for result in results if result["roughness"] <= 0.8]
    high = [result for result in results if result["roughness"] > 0.8]

    def of(controller: str) -> Judgement:
        below, above = (
            rate(successes(part, column, controller=controller)) for part in (low, high)
        )
        test = compare_rates(below, above)
        text = f"{below} up to R = 0.8, {above} above, {p_text(test.p)}"
        if below.successes < MIN_SEEDS or above.trials < MIN_SEEDS:
            return Judgement(text, FEW)
        full = below.value == 1.0 and above.value < 1.0
        return Judgement(text, verdict(full, test.effect < 0 and test.p <= SIGNIFICANT))

    return each_of(TEGOTAE, of)


CLAIMS: Final = (
    Claim("3.1.3, Fig. 6", "rougher ground takes longer, in all methods",
          time_trend("roughness", 1, ALL), ALL),
    Claim("3.1.3, Fig. 6", "the spread of the time grows with the roughness",
          both_criteria(spread_grows), ALL),
    Claim("3.1.3, Fig. 6", "above R = 80 % Tegotae does not always form a gait",
          both_criteria(fails_above), TEGOTAE),
    Claim("3.1.3, Fig. 6", "APNC forms the gait at every roughness", always("apnc")),
    Claim("3.1.3, Fig. 6", "APNC converges faster than Tegotae",
          faster([("apnc", other) for other in TEGOTAE], "roughness"), ("apnc", *TEGOTAE)),
    Claim("3.1.3, Fig. 6", "APNC converges faster than phase resetting",
          faster([("apnc", other) for other in PHASE_RESET], "roughness"), ("apnc", *PHASE_RESET)),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["terrain"],
    experiment,
    {"roughness": ROUGHNESS},
    seeds=fewer_of_others(roughness=OTHERS_ROUGHNESS),
    claims=CLAIMS,
    figures=lambda results: convergence(results, ("roughness", "roughness R [1]")),
)
