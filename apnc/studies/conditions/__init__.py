"""Section 3.1.4, Fig. 7: balance, coordination and cost in the robot's conditions C1 to C4."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, Final, NamedTuple

from apnc.controllers import ALL, distinct, named_controller
from apnc.loop.experiment import Experiment
from apnc.report.figure import Figure
from apnc.studies.claims import FEW, SIGNIFICANT, Claim, Judgement, Rule, verdict
from apnc.studies.plots import over_axis
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import Result, cells_in, controllers_in, matching, values
from apnc.studies.statistics import Comparison, compare, holm, of_runs, p_text
from apnc.studies.study import WALK_MI, WALK_S, Study, fewer_of_others

COMPARED: Final = distinct(ALL, "conditions")

METRICS: Final = {
    "balance": "balance [1/rad]",
    "coordination": "coordination [1]",
    "cost_of_transport": "cost of transport [1]",
}
LESS_IS_BETTER: Final = ("cost_of_transport",)


class Compared(NamedTuple):
    """APNC against a baseline in one metric and condition.

    Args:
        metric: name of the metric.
        condition: name of the condition.
        controller: label of the baseline.
        n: numbers of runs of APNC and of the baseline that have the metric, as text.
        test: test with p corrected over all tests (Holm). None if APNC or the baseline has the
            metric in fewer than ``MIN_SEEDS`` runs or in less than half of them. A robot that
            stands has none, and the runs that are left would be no fair sample.
    """

    metric: str
    condition: str
    controller: str
    n: str
    test: Comparison | None

    @property
    def differs(self) -> bool:
        """Whether the difference is significant."""
        return self.test is not None and self.test.p <= SIGNIFICANT

    @property
    def better(self) -> bool:
        """Whether APNC is significantly better."""
        sign = -1.0 if self.metric in LESS_IS_BETTER else 1.0
        return self.differs and self.test is not None and sign * self.test.effect > 0

    @property
    def text(self) -> str:
        """The comparison as text."""
        words = f"{self.metric} against {named_controller(self.controller).name}"
        if self.test is None:
            return f"{words}: too few, n = {self.n}"
        return f"{words}: {p_text(self.test.p)}, r = {self.test.effect:.2f}, n = {self.n}"


def experiment(condition: str, **fields: Any) -> Experiment:
    """A walk in a condition of the paper."""
    return Experiment(conditions=condition, mi=WALK_MI, duration=WALK_S, **fields)


def comparisons(results: Sequence[Result]) -> list[Compared]:
    """Comparisons of APNC with every baseline that was run."""
    baselines = [controller for controller in controllers_in(results) if controller != "apnc"]
    cells = product(METRICS, cells_in(results, "condition"), baselines)
    found = [_compared(results, *cell) for cell in cells]
    corrected = iter(holm([each.test for each in found if each.test]))
    return [each._replace(test=next(corrected)) if each.test else each for each in found]


def _compared(results: Sequence[Result], metric: str, condition: str, baseline: str) -> Compared:
    runs = [matching(results, controller=m, condition=condition) for m in ("apnc", baseline)]
    found = [values(own, metric) for own in runs]
    enough = all(len(v) >= max(MIN_SEEDS, len(own) / 2) for v, own in zip(found, runs, strict=True))
    n = " and ".join(of_runs(len(v), len(own)) for v, own in zip(found, runs, strict=True))
    return Compared(metric, condition, baseline, n, compare(*found) if enough else None)


def alike_in(condition: str) -> Rule:
    """Rule: no test in a condition finds a difference. Half of them is partly."""
    return _in_condition(condition, lambda test: not test.differs, lambda share: share >= 0.5)


def better_in(condition: str) -> Rule:
    """Rule: every test in a condition finds APNC better. More than half of them is partly."""
    return _in_condition(condition, lambda test: test.better, lambda share: share > 0.5)


def _in_condition(
    condition: str, holds: Callable[[Compared], bool], enough: Callable[[float], bool]
) -> Rule:
    """Rule on all tests of a condition. It is partly at most if a test could not be made."""

    def rule(results: Sequence[Result]) -> Judgement:
        tests = [test for test in comparisons(results) if test.condition == condition]
        told = [holds(test) for test in tests if test.test]
        text = "; ".join(test.text for test in tests)
        if not told:
            return Judgement(text, FEW)
        full = all(told) and len(told) == len(tests)
        return Judgement(text, verdict(full, enough(sum(told) / len(told))))

    return rule


def figures(results: Sequence[Result]) -> list[Figure]:
    """A figure per metric. Its note lists where APNC differs from a baseline."""
    found, tests = [], [test for test in comparisons(results) if test.differs]
    for metric, label in METRICS.items():
        differs = [
            f"{t.condition} {named_controller(t.controller).name} "
            f"({p_text(t.test.p)}, r = {t.test.effect:.2f})"
            for t in tests
            if t.metric == metric and t.test
        ]
        note = f"APNC differs from: {'; '.join(differs) or 'no baseline'}. Mann-Whitney U, Holm."
        found.append(over_axis(results, ("condition", "condition"), metric, label, note))
    return found


CLAIMS: Final = (
    Claim("3.1.4, Fig. 7", "in C1 all methods do about equally well", alike_in("C1"), COMPARED),
    Claim("3.1.4, Fig. 7", "with noise (C2) APNC is better in all metrics",
          better_in("C2"), COMPARED),
    Claim("3.1.4, Fig. 7", "with a damaged leg (C3) APNC is better in all metrics",
          better_in("C3"), COMPARED),
    Claim("3.1.4, Fig. 7", "with a payload (C4) APNC is better in all metrics",
          better_in("C4"), COMPARED),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["conditions"],
    experiment,
    {"condition": ("C1", "C2", "C3", "C4")},
    controllers=COMPARED,
    seeds=fewer_of_others(),
    claims=CLAIMS,
    figures=figures,
)
