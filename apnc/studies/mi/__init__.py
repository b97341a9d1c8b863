"""Section 3.1.1: does the gait form at every stepping frequency, and how fast?"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Final

import numpy as np
from scipy import stats

from apnc import metrics
from apnc.controllers import ALL, PHASE_RESET, TEGOTAE, named_controller
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies.claims import (
    FEW,
    Claim,
    Judgement,
    Rule,
    both_criteria,
    faster,
    trend,
    verdict,
)
from apnc.studies.plots import convergence, over_axis
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import (
    AUTHORS,
    SPEED,
    STRICT,
    Result,
    cells_in,
    controllers_in,
    is_number,
    matching,
    successes,
    values,
)
from apnc.studies.statistics import median, rate
from apnc.studies.study import WALK_S, Study, fewer_of_others
from apnc.studies.table import markdown, middle

MI_VALUES: Final = tuple(round(0.04 + 0.02 * i, 2) for i in range(13))
OTHERS_MI: Final = MI_VALUES[::2]
"""MI at which the controllers other than APNC walk, with half of the seeds."""

AXIS: Final = ("mi", "MI [1]")
GAIT: Final = "gait_at_the_end"

SETTLED_S: Final = 5.0
"""Time at the end of a run over which the gait is named [s]."""

COHERENT: Final = 0.9
"""Smallest coherence of settled phases. A drift through a quarter of a cycle has this value [1]."""

DUTY, STRIDE = "duty_factor_mean", "stride_frequency_hz"


def within(limit: float) -> Rule:
    """Rule: the median time of APNC is at most a limit [s], and every trial forms the gait.

    Partly if not every trial forms it.
    """

    def check(results: Sequence[Result], column: str) -> Judgement:
        time = median(values(results, column, controller="apnc"))
        hits = rate(successes(results, column, controller="apnc"))
        fast = time.size > 0 and time.value <= limit
        text = f"{time.text(1, 's')}, success {hits}"
        return Judgement(text, verdict(fast and hits.value == 1.0, fast))

    return both_criteria(check)


def duty_at_high_mi(results: Sequence[Result]) -> Judgement:
    """From MI 0.24 on the median duty factor is within 0.05 of 0.72. Within 0.1 is partly."""
    high = [result for result in matching(results, controller="apnc") if result["mi"] >= 0.24]
    duty = median(values(high, DUTY))
    off = abs(duty.value - 0.72)
    text = duty.text(2, runs=len(high))
    return Judgement(text, verdict(off <= 0.05, off <= 0.1) if duty.size >= MIN_SEEDS else FEW)


def stride_line(results: Sequence[Result]) -> Judgement:
    """The median frequency of the oscillators is within 15 % of 8.6 MI + 0.5 Hz.

    Partly if it only rises with MI.
    """
    known = [
        result for result in matching(results, controller="apnc") if is_number(result.get(STRIDE))
    ]
    if len({result["mi"] for result in known}) < 3:
        return Judgement("too few", FEW)
    mi, frequency = (np.array([result[name] for result in known]) for name in ("mi", STRIDE))
    fit = stats.linregress(mi, frequency)
    off = float(np.median(np.abs(frequency / (8.6 * mi + 0.5) - 1.0)))
    line = f"S_f = {fit.slope:.1f} MI + {fit.intercept:.2f}"
    text = f"{line}; the median stride is {100 * off:.0f} % off the paper's line"
    return Judgement(text, verdict(off <= 0.15, fit.slope > 0))


def measure(record: Record) -> Result:
    """The gait at the end. None for a run that is not complete.

    Returns:
        ``gait_at_the_end``: name of the gait within 0.6 rad of the mean phases of the last 5 s.
        "unsettled" if the phases still move, "no name" if they are those of no known gait.
    """
    if not record.complete:
        return {GAIT: None}
    o1, o2 = record.signals["o1"], record.signals["o2"]
    period, span = 1.0 / record.experiment.rate, SETTLED_S
    if (metrics.coherence(o1, o2, period, span) or 0.0) < COHERENT:
        return {GAIT: "unsettled"}
    final = metrics.final_phases(o1, o2, period, span)
    return {GAIT: metrics.nearest_gait(final, metrics.STRICT_TOLERANCE) or "no name"}


def table(results: Sequence[Result]) -> str:
    """A line per controller and MI. A trial that ended with an error counts as a failure."""
    cells = [
        (controller, mi) for controller in controllers_in(results) for mi in cells_in(results, "mi")
    ]
    groups = [(*cell, matching(results, controller=cell[0], mi=cell[1])) for cell in cells]
    return markdown(_line(*group) for group in groups if group[2])


def _line(controller: str, mi: float, results: list[Result]) -> dict[str, str]:
    strict, loose, hits = (
        values(results, STRICT),
        values(results, AUTHORS),
        rate(successes(results)),
    )
    low, half, high, longest = np.percentile(strict, [25, 50, 75, 100]) if strict else [0.0] * 4
    spread = f"{half:.1f} ({low:.1f} ... {high:.1f}; {longest:.1f})" if strict else "-"
    return {
        "controller": named_controller(controller).name,
        "MI": f"{mi:.2f}",
        "gait kept, strict (95 % interval)": str(hits),
        "strict time [s], median (quartiles; longest)": spread,
        "gait at the end": gaits(results),
        "authors' criterion": f"{len(loose)}/{len(results)}",
        "authors' time [s], median": f"{np.median(loose):.1f}" if loose else "-",
        "speed [m/s], median (range)": middle(values(results, "late_speed_m_per_s"), 3),
        "fell": str(len(matching(results, fell=True))),
    }


def gaits(results: Sequence[Result]) -> str:
    """Number of runs by gait at the end, the most frequent first: ``tripod 17, unsettled 3``."""
    count = Counter(result[GAIT] for result in results if result.get(GAIT))
    return ", ".join(f"{name} {runs}" for name, runs in count.most_common()) or "-"


CLAIMS: Final = (
    Claim("abstract, 3.1.1", "the gait forms rapidly, within a few seconds", within(9.0)),
    Claim("3.1.1, Fig. 4", "APNC converges faster than Tegotae",
          faster([("apnc", other) for other in TEGOTAE], "mi"), ("apnc", *TEGOTAE)),
    Claim("3.1.1, Fig. 4", "phase resetting converges faster than Tegotae",
          faster(list(zip(PHASE_RESET, TEGOTAE, strict=True)), "mi"), (*PHASE_RESET, *TEGOTAE)),
    Claim("3.1.1, Fig. S4", "the duty factor grows with MI",
          trend(DUTY, "mi", 1)),
    Claim("3.1.1", "from MI 0.24 on the duty factor settles at about 0.72", duty_at_high_mi),
    Claim("3.1.1", "the stride frequency is about 8.6 MI + 0.5 Hz", stride_line),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["mi"],
    partial(Experiment, duration=WALK_S),
    {"mi": MI_VALUES},
    controllers=("apnc", "apc", *ALL[1:]),
    seeds=fewer_of_others(mi=OTHERS_MI),
    measure=measure,
    claims=CLAIMS,
    figures=lambda results: [
        *convergence(results, AXIS),
        over_axis(results, AXIS, DUTY, "duty factor [1]"),
        over_axis(results, AXIS, SPEED, "speed [m/s]"),
    ],
    table=table,
)
