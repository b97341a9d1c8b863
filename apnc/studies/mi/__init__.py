"""Section 3.1.1: does the gait form at every stepping frequency, and how fast?"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

import numpy as np
from scipy import stats

from apnc.loop.experiment import Experiment
from apnc.studies.claims import NO, Claim, Finding, Rule, faster, trend, verdict
from apnc.studies.plots import convergence, over_axis
from apnc.studies.rows import (
    AUTHORS,
    SPEED,
    STRICT,
    Row,
    cells_in,
    is_number,
    matching,
    methods_in,
    successes,
    values,
)
from apnc.studies.statistics import median, rate
from apnc.studies.study import WALK_S, Study
from apnc.studies.table import markdown, middle

MI_VALUES: Final = tuple(round(0.04 + 0.02 * i, 2) for i in range(13))
AXIS: Final = ("mi", "MI [1]")
DUTY, STRIDE = "duty_factor_mean", "stride_frequency_hz"


def within(limit: float) -> Rule:
    """The median strict time of APNC is at most a limit [s], and every trial forms the gait."""

    def rule(rows: Sequence[Row]) -> Finding:
        strict, loose = (median(values(rows, c, method="apnc")) for c in (STRICT, AUTHORS))
        hits = rate(successes(rows, method="apnc"))
        fast = strict.size > 0 and strict.value <= limit
        text = f"strict: {strict.text(1, 's')}, success {hits}; authors': {loose.text(1, 's')}"
        return Finding(text, verdict(fast and hits.value == 1.0, fast))

    return rule


def duty_at_high_mi(rows: Sequence[Row]) -> Finding:
    """From MI 0.24 on the median duty factor is within 0.05 of 0.72; above 0.5 is 'partly'."""
    duty = median(values([row for row in rows if row["mi"] >= 0.24], DUTY, method="apnc"))
    near = duty.size > 0 and abs(duty.value - 0.72) <= 0.05
    return Finding(duty.text(2), verdict(near, duty.size > 0 and duty.value > 0.5))


def stride_line(rows: Sequence[Row]) -> Finding:
    """The median stride frequency is within 15 % of 8.6 MI + 0.5 Hz; growing is 'partly'."""
    known = [row for row in matching(rows, method="apnc") if is_number(row.get(STRIDE))]
    if len({row["mi"] for row in known}) < 3:
        return Finding("too few", NO)
    mi, frequency = (np.array([row[name] for row in known]) for name in ("mi", STRIDE))
    fit = stats.linregress(mi, frequency)
    off = float(np.median(np.abs(frequency / (8.6 * mi + 0.5) - 1.0)))
    line = f"S_f = {fit.slope:.1f} MI + {fit.intercept:.2f}"
    text = f"{line}; the median stride is {100 * off:.0f} % off the paper's line"
    return Finding(text, verdict(off <= 0.15, fit.slope > 0))


def table(rows: Sequence[Row]) -> str:
    """A line per method and MI; a trial that ended with an error counts as a failure."""
    cells = [(method, mi) for method in methods_in(rows) for mi in cells_in(rows, "mi")]
    groups = [(*cell, matching(rows, method=cell[0], mi=cell[1])) for cell in cells]
    return markdown(_line(*group) for group in groups if group[2])


def _line(method: str, mi: float, rows: list[Row]) -> dict[str, str]:
    strict, loose, hits = values(rows, STRICT), values(rows, AUTHORS), rate(successes(rows))
    low, half, high, longest = np.percentile(strict, [25, 50, 75, 100]) if strict else [0.0] * 4
    spread = f"{half:.1f} ({low:.1f} ... {high:.1f}; {longest:.1f})" if strict else "-"
    return {
        "method": method,
        "MI": f"{mi:.2f}",
        "gait kept, strict (95 % interval)": str(hits),
        "strict time [s], median (quartiles; longest)": spread,
        "authors' criterion": f"{len(loose)}/{len(rows)}",
        "authors' time [s], median": f"{np.median(loose):.1f}" if loose else "-",
        "speed [m/s], median (range)": middle(values(rows, "late_speed_m_per_s"), 3),
        "fell": str(len(matching(rows, fell=True))),
    }


CLAIMS: Final = (
    Claim("abstract, 3.1.1", "the gait forms rapidly, within a few seconds", within(9.0)),
    Claim("3.1.1, Fig. 4", "APNC converges faster than Tegotae",
          faster("apnc", "tegotae", "mi"), ("apnc", "tegotae")),
    Claim("3.1.1, Fig. 4", "phase resetting converges faster than Tegotae",
          faster("phase_reset", "tegotae", "mi"), ("phase_reset", "tegotae")),
    Claim("3.1.1, Fig. S4", "the duty factor grows with MI",
          trend(DUTY, "mi", 1, ("apnc",), "duty factor and MI")),
    Claim("3.1.1", "from MI 0.24 on the duty factor settles at about 0.72", duty_at_high_mi),
    Claim("3.1.1", "the stride frequency is about 8.6 MI + 0.5 Hz", stride_line),
)  # fmt: skip

STUDY: Final = Study(
    "mi",
    partial(Experiment, duration=WALK_S),
    {"mi": MI_VALUES},
    methods=("apnc", "apc", "tegotae", "phase_reset"),
    claims=CLAIMS,
    figures=lambda rows: [
        *convergence(rows, AXIS),
        over_axis(rows, AXIS, DUTY, "duty factor [1]"),
        over_axis(rows, AXIS, SPEED, "speed [m/s]"),
    ],
    table=table,
)
