"""Section 3.1.2: the gait at low and high update rates of the controller."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from apnc.loop.experiment import Experiment
from apnc.studies.claims import Claim, Part, Rule, always, both_criteria, faster, trend
from apnc.studies.plots import convergence
from apnc.studies.rows import STRICT, Row, successes
from apnc.studies.statistics import rate
from apnc.studies.study import BASELINES, WALK_MI, Study


def only_above(limit: float, methods: Sequence[str]) -> Rule:
    """Above a rate [Hz] every trial of these methods forms the gait, up to it not every one."""

    def check(rows: Sequence[Row], column: str) -> Part:
        low = [row for row in rows if row["rate"] <= limit]
        high = [row for row in rows if row["rate"] > limit]
        texts, good = [], 0
        for method in methods:
            below, above = (rate(successes(r, column, method=method)) for r in (low, high))
            good += above.value == 1.0 and below.value < 1.0
            texts.append(f"{method}: {below} up to {limit:g} Hz, {above} above")
        return "; ".join(texts), good == len(methods), good > 0

    return both_criteria(check)


CLAIMS: Final = (
    Claim("3.1.2, Fig. 5", "a higher update rate converges sooner, in all methods",
          trend(STRICT, "rate", -1, BASELINES, "strict time and rate"), BASELINES),
    Claim("3.1.2, Fig. 5", "APNC succeeds in every trial at every rate", always("apnc")),
    Claim("3.1.2, Fig. 5", "Tegotae and phase resetting always succeed only above 25 Hz",
          only_above(25.0, BASELINES[1:]), BASELINES[1:]),
    Claim("3.1.2, Fig. 5", "APNC converges faster than Tegotae at every rate",
          faster("apnc", "tegotae", "rate"), ("apnc", "tegotae")),
)  # fmt: skip

STUDY: Final = Study(
    "rate",
    partial(Experiment, mi=WALK_MI, duration=60.0),
    {"rate": tuple(float(5 * i) for i in range(1, 13))},
    claims=CLAIMS,
    figures=lambda rows: convergence(rows, ("rate", "update rate [Hz]")),
)
