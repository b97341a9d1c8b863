"""Section 3.1.3: the gait on ground with obstacles, other ones for every seed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.studies.claims import Claim, Finding, always, faster, trend, verdict
from apnc.studies.plots import convergence
from apnc.studies.rows import AUTHORS, STRICT, Row, successes, values
from apnc.studies.statistics import rate
from apnc.studies.study import BASELINES, WALK_MI, WALK_S, Study
from exudyn_models.ground import Ground


def experiment(method: str, seed: int, roughness: float) -> Experiment:
    """A walk over obstacles."""
    ground = Ground(roughness=roughness, seed=seed)
    return Experiment(method=method, seed=seed, ground=ground, mi=WALK_MI, duration=WALK_S)


def spread_grows(rows: Sequence[Row]) -> Finding:
    """The strict time scatters more above R = 0.5 than up to it, in every method."""
    smooth = [row for row in rows if row["roughness"] <= 0.5]
    rough = [row for row in rows if row["roughness"] > 0.5]
    texts, agree = [], 0
    for method in BASELINES:
        a, b = (values(part, STRICT, method=method) for part in (smooth, rough))
        if len(a) < 2 or len(b) < 2:
            texts.append(f"{method}: too few")
            continue
        agree += bool(np.std(b) > np.std(a))
        texts.append(f"{method}: {np.std(a):.1f} s up to R = 0.5, {np.std(b):.1f} s above")
    full, part = agree == len(BASELINES), agree > 0
    return Finding("standard deviation, " + "; ".join(texts), verdict(full, part))


def not_always_above_08(rows: Sequence[Row]) -> Finding:
    """Above R = 0.8 not every trial of Tegotae forms the gait by the strict criterion."""
    high = [row for row in rows if row["roughness"] > 0.8]
    strict, loose = (rate(successes(high, c, method="tegotae")) for c in (STRICT, AUTHORS))
    full = strict.trials > 0 and strict.value < 1.0
    return Finding(f"strict: {strict}; authors': {loose}", verdict(full, False))


CLAIMS: Final = (
    Claim("3.1.3, Fig. 6", "rougher ground takes longer, in all methods",
          trend(STRICT, "roughness", 1, BASELINES, "strict time and R"), BASELINES),
    Claim("3.1.3, Fig. 6", "the spread of the time grows with the roughness",
          spread_grows, BASELINES),
    Claim("3.1.3, Fig. 6", "above R = 80 % Tegotae does not always form a gait",
          not_always_above_08, ("tegotae",)),
    Claim("3.1.3, Fig. 6", "APNC forms the gait at every roughness", always("apnc")),
    Claim("3.1.3, Fig. 6", "APNC converges faster than Tegotae",
          faster("apnc", "tegotae", "roughness"), ("apnc", "tegotae")),
    Claim("3.1.3, Fig. 6", "APNC converges faster than phase resetting",
          faster("apnc", "phase_reset", "roughness"), ("apnc", "phase_reset")),
)  # fmt: skip

STUDY: Final = Study(
    "terrain",
    experiment,
    {"roughness": tuple(round(0.1 * i, 1) for i in range(11))},
    claims=CLAIMS,
    figures=lambda rows: convergence(rows, ("roughness", "roughness R [1]")),
)
