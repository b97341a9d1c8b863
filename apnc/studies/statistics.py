"""Intervals and tests on numbers of trials."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy import stats

CONFIDENCE: Final = 0.95


class Rate(NamedTuple):
    """A success rate with its exact 95 % interval (Clopper and Pearson 1934)."""

    successes: int
    trials: int
    low: float
    high: float

    @property
    def value(self) -> float:
        """Share of successes; nan without a trial."""
        return self.successes / self.trials if self.trials else float("nan")

    def __str__(self) -> str:
        return f"{self.successes}/{self.trials} ({100 * self.low:.0f} ... {100 * self.high:.0f} %)"


def rate(outcomes: Sequence[bool]) -> Rate:
    """Success rate of ``outcomes``."""
    n, k = len(outcomes), sum(outcomes)
    if n == 0:
        return Rate(0, 0, 0.0, 1.0)
    interval = stats.binomtest(k, n).proportion_ci(CONFIDENCE, method="exact")
    return Rate(k, n, float(interval.low), float(interval.high))


def of_runs(size: int, runs: int) -> str:
    """How many of the runs have a figure: their number if all do."""
    return str(size) if size == runs else f"{size} of {runs}"


class Median(NamedTuple):
    """A median with its bootstrap 95 % interval, all nan without a value."""

    value: float
    low: float
    high: float
    size: int

    def text(self, digits: int = 2, unit: str = "", runs: int | None = None) -> str:
        """Value and interval, or a dash if there is nothing to take it of.

        Args:
            digits: after the point.
            unit: put behind.
            runs: of which those with a number are told.
        """
        n = "" if runs is None else f", n = {of_runs(self.size, runs)}"
        if self.size == 0:
            return f"-{n}"
        spread = f"{self.low:.{digits}f} ... {self.high:.{digits}f}"
        return f"{self.value:.{digits}f} ({spread}) {unit}".strip() + n


def median(values: Sequence[float]) -> Median:
    """Median of ``values`` with a percentile-bootstrap interval of fixed seed."""
    sample = np.asarray(values, dtype=np.float64)
    if sample.size == 0:
        return Median(float("nan"), float("nan"), float("nan"), 0)
    middle = float(np.median(sample))
    if np.ptp(sample) == 0.0:
        return Median(middle, middle, middle, sample.size)
    interval = stats.bootstrap(
        (sample,),
        np.median,
        confidence_level=CONFIDENCE,
        n_resamples=2000,
        method="percentile",
        rng=np.random.default_rng(0),
    ).confidence_interval
    return Median(middle, float(interval.low), float(interval.high), sample.size)


class Comparison(NamedTuple):
    """p and size of an effect, between -1 and 1."""

    p: float
    effect: float


def p_text(p: float) -> str:
    """``p = 0.042``, ``p = 1``, ``p < 0.001``."""
    return "p < 0.001" if p < 0.001 else f"p = {p:.2g}"


def rank_correlation(x: Sequence[float], y: Sequence[float]) -> Comparison | None:
    """Spearman's rho of pairs; None with fewer than three, or if x or y are all equal."""
    if len(x) < 3 or len(set(x)) < 2 or len(set(y)) < 2:
        return None
    test = stats.spearmanr(x, y)
    return Comparison(float(test.pvalue), float(test.statistic))


def compare(a: Sequence[float], b: Sequence[float]) -> Comparison:
    """Two-sided Mann-Whitney U test; p = 1 if either is empty or all are equal.

    The effect is the rank-biserial correlation: 1 if every a exceeds every b, -1 if none does.
    """
    if not a or not b or len({*a, *b}) == 1:
        return Comparison(1.0, 0.0)
    test = stats.mannwhitneyu(a, b, alternative="two-sided")
    return Comparison(float(test.pvalue), float(2.0 * test.statistic / (len(a) * len(b)) - 1.0))


def compare_rates(a: Rate, b: Rate) -> Comparison:
    """Fisher's exact test; the effect is by how much the share of b exceeds that of a."""
    if not a.trials or not b.trials:
        return Comparison(1.0, 0.0)
    table = [[r.successes, r.trials - r.successes] for r in (a, b)]
    return Comparison(float(stats.fisher_exact(table).pvalue), b.value - a.value)


def compare_spread(a: Sequence[float], b: Sequence[float]) -> Comparison:
    """Brown and Forsythe's test of equal spread, for two values each and more.

    The effect is the share by which the standard deviation of b exceeds that of a, of both.
    """
    spreads = float(np.std(a)), float(np.std(b))
    if sum(spreads) == 0.0:
        return Comparison(1.0, 0.0)
    test = stats.levene(a, b, center="median")
    return Comparison(float(test.pvalue), (spreads[1] - spreads[0]) / sum(spreads))


def holm(tests: Sequence[Comparison]) -> list[Comparison]:
    """The same tests with p corrected by Holm's step-down procedure."""
    corrected = [test.p for test in tests]
    floor = 0.0
    for rank, i in enumerate(sorted(range(len(tests)), key=lambda i: tests[i].p)):
        floor = max(floor, min(1.0, tests[i].p * (len(tests) - rank)))
        corrected[i] = floor
    return [test._replace(p=p) for test, p in zip(tests, corrected, strict=True)]
