"""Confidence intervals and tests for the measures of trials."""

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
        """Share of successes. NaN without a trial."""
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
    """Number of runs that have a measure, with "of ..." if not all have it."""
    return str(size) if size == runs else f"{size} of {runs}"


class Median(NamedTuple):
    """A median with its bootstrap 95 % interval. All are NaN without a value."""

    value: float
    low: float
    high: float
    size: int

    def text(self, digits: int = 2, unit: str = "", runs: int | None = None) -> str:
        """Median and interval as text, or a dash without a value.

        Args:
            digits: digits after the point.
            unit: unit to append.
            runs: number of runs. If given, the number of those with a value is appended.
        """
        n = "" if runs is None else f", n = {of_runs(self.size, runs)}"
        if self.size == 0:
            return f"-{n}"
        spread = f"{self.low:.{digits}f} ... {self.high:.{digits}f}"
        return f"{self.value:.{digits}f} ({spread}) {unit}".strip() + n


def median(values: Sequence[float]) -> Median:
    """Median of ``values`` with a percentile bootstrap interval. The seed is fixed."""
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
    """p of a test, and size of the effect between -1 and 1."""

    p: float
    effect: float


def p_text(p: float) -> str:
    """``p = 0.042``, ``p = 1``, ``p < 0.001``."""
    return "p < 0.001" if p < 0.001 else f"p = {p:.2g}"


def rank_correlation(x: Sequence[float], y: Sequence[float]) -> Comparison | None:
    """Spearman's rho. None with fewer than three pairs, or if all x or all y are equal."""
    if len(x) < 3 or len(set(x)) < 2 or len(set(y)) < 2:
        return None
    test = stats.spearmanr(x, y)
    return Comparison(float(test.pvalue), float(test.statistic))


def compare(a: Sequence[float], b: Sequence[float]) -> Comparison:
    """Two-sided Mann-Whitney U test. p is 1 if a or b is empty, or if all numbers are equal.

    The effect is the rank-biserial correlation: 1 if every a exceeds every b, -1 if none does.
    """
    if not a or not b or len({*a, *b}) == 1:
        return Comparison(1.0, 0.0)
    test = stats.mannwhitneyu(a, b, alternative="two-sided")
    return Comparison(float(test.pvalue), float(2.0 * test.statistic / (len(a) * len(b)) - 1.0))


def compare_rates(a: Rate, b: Rate) -> Comparison:
    """Fisher's exact test. The effect is the share of b minus that of a."""
    if not a.trials or not b.trials:
        return Comparison(1.0, 0.0)
    table = [[r.successes, r.trials - r.successes] for r in (a, b)]
    return Comparison(float(stats.fisher_exact(table).pvalue), b.value - a.value)


def compare_spread(a: Sequence[float], b: Sequence[float]) -> Comparison:
    """Brown and Forsythe's test of equal spread. a and b need two values each.

    The effect is (s_b - s_a) / (s_b + s_a), with s the standard deviation.
    """
    spreads = float(np.std(a)), float(np.std(b))
    if sum(spreads) == 0.0:
        return Comparison(1.0, 0.0)
    test = stats.levene(a, b, center="median")
    return Comparison(float(test.pvalue), (spreads[1] - spreads[0]) / sum(spreads))


def holm(tests: Sequence[Comparison]) -> list[Comparison]:
    """The tests with p corrected by Holm's step-down procedure."""
    corrected = [test.p for test in tests]
    floor = 0.0
    for rank, i in enumerate(sorted(range(len(tests)), key=lambda i: tests[i].p)):
        floor = max(floor, min(1.0, tests[i].p * (len(tests) - rank)))
        corrected[i] = floor
    return [test._replace(p=p) for test, p in zip(tests, corrected, strict=True)]
