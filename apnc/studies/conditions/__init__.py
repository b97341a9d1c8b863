"""Section 3.1.4, Fig. 7: balance, coordination and cost in the robot's conditions C1 to C4."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Final, NamedTuple

from apnc.loop.experiment import Experiment
from apnc.report.figure import Figure
from apnc.studies.claims import SIGNIFICANT, Claim, Finding, Rule, verdict
from apnc.studies.plots import over_axis, style
from apnc.studies.rows import Row, cells_in, methods_in, values
from apnc.studies.statistics import compare, holm, p_text
from apnc.studies.study import BASELINES, WALK_MI, WALK_S, Study

METRICS: Final = {
    "balance": "balance [1/rad]",
    "coordination": "coordination [1]",
    "cost_of_transport": "cost of transport [1]",
}
LESS_IS_BETTER: Final = ("cost_of_transport",)


class Compared(NamedTuple):
    """APNC against a baseline in one metric and condition."""

    metric: str
    condition: str
    method: str
    p: float
    effect: float

    @property
    def better(self) -> bool:
        """Whether APNC is significantly better."""
        sign = -1.0 if self.metric in LESS_IS_BETTER else 1.0
        return self.p <= SIGNIFICANT and sign * self.effect > 0

    @property
    def word(self) -> str:
        """The same in words."""
        return "better" if self.better else "no better"


def experiment(method: str, seed: int, condition: str) -> Experiment:
    """A walk of a robot in a condition of the paper."""
    return Experiment(method=method, seed=seed, conditions=condition, mi=WALK_MI, duration=WALK_S)


def comparisons(rows: Sequence[Row]) -> list[Compared]:
    """APNC against every baseline that was run; p corrected over all tests (Holm)."""
    baselines = [method for method in methods_in(rows) if method != "apnc"]
    cells = list(product(METRICS, cells_in(rows, "condition"), baselines))
    tests = []
    for metric, condition, baseline in cells:
        own, other = (
            values(rows, metric, method=m, condition=condition) for m in ("apnc", baseline)
        )
        tests.append(compare(own, other))
    return [Compared(*cell, *test) for cell, test in zip(cells, holm(tests), strict=True)]


def alike_in(condition: str) -> Rule:
    """No test in a condition finds a difference."""

    def rule(rows: Sequence[Row]) -> Finding:
        tests = [test for test in comparisons(rows) if test.condition == condition]
        alike = sum(test.p > SIGNIFICANT for test in tests)
        texts = (f"{t.metric} against {t.method}: {p_text(t.p)}, r = {t.effect:.2f}" for t in tests)
        return Finding("; ".join(texts), verdict(alike == len(tests) > 0, alike > 0))

    return rule


def better_in(condition: str) -> Rule:
    """Every test in a condition finds APNC better; more than half are 'partly'."""

    def rule(rows: Sequence[Row]) -> Finding:
        tests = [test for test in comparisons(rows) if test.condition == condition]
        better = sum(test.better for test in tests)
        texts = (f"{t.metric} {t.word} than {t.method} (r = {t.effect:.2f})" for t in tests)
        full, part = better == len(tests) > 0, better > len(tests) / 2
        return Finding("; ".join(texts), verdict(full, part))

    return rule


def figures(rows: Sequence[Row]) -> list[Figure]:
    """A metric each; the note says where APNC differs from a baseline."""
    found, tests = [], [test for test in comparisons(rows) if test.p <= SIGNIFICANT]
    for metric, label in METRICS.items():
        differs = [
            f"{t.condition} {style(t.method)[0]} ({p_text(t.p)}, r = {t.effect:.2f})"
            for t in tests
            if t.metric == metric
        ]
        note = f"APNC differs from: {'; '.join(differs) or 'no baseline'}. Mann-Whitney U, Holm."
        found.append(over_axis(rows, ("condition", "condition"), metric, label, note))
    return found


CLAIMS: Final = (
    Claim("3.1.4, Fig. 7", "in C1 all methods do about equally well", alike_in("C1"), BASELINES),
    Claim("3.1.4, Fig. 7", "with noise (C2) APNC is better in all metrics",
          better_in("C2"), BASELINES),
    Claim("3.1.4, Fig. 7", "with a damaged leg (C3) APNC is better in all metrics",
          better_in("C3"), BASELINES),
    Claim("3.1.4, Fig. 7", "with a payload (C4) APNC is better in all metrics",
          better_in("C4"), BASELINES),
)  # fmt: skip

STUDY: Final = Study(
    "conditions",
    experiment,
    {"condition": ("C1", "C2", "C3", "C4")},
    claims=CLAIMS,
    figures=figures,
)
