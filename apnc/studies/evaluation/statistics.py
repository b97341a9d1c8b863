"""Intervals and tests on trial rows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Rate:
    """A success rate with its exact (Clopper-Pearson) 95 % interval."""

    successes: int
    trials: int
    low: float
    high: float

    @property
    def value(self) -> float:
        """Share of successes."""
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


@dataclass(frozen=True)
class Median:
    """A median with its bootstrap 95 % interval."""

    value: float
    low: float
    high: float
    count: int

    def text(self, digits: int = 2, unit: str = "") -> str:
        """Value and interval, or a dash if there is nothing to take it of."""
        if self.count == 0:
            return "-"
        spread = f"{self.low:.{digits}f} ... {self.high:.{digits}f}"
        return f"{self.value:.{digits}f} ({spread}) {unit}".strip()


def median(values: Sequence[float]) -> Median:
    """Median of ``values`` with a percentile-bootstrap interval of fixed seed."""
    sample = np.asarray(values, dtype=np.float64)
    if sample.size == 0:
        return Median(float("nan"), float("nan"), float("nan"), 0)
    if sample.size == 1 or np.ptp(sample) == 0.0:
        only = float(np.median(sample))
        return Median(only, only, only, int(sample.size))
    result = stats.bootstrap(
        (sample,),
        np.median,
        confidence_level=CONFIDENCE,
        n_resamples=2000,
        method="percentile",
        rng=np.random.default_rng(0),
    )
    interval = result.confidence_interval
    middle = float(np.median(sample))
    return Median(middle, float(interval.low), float(interval.high), int(sample.size))


@dataclass(frozen=True)
class Comparison:
    """Two-sided Mann-Whitney U test of a against b.

    ``effect`` is the rank-biserial correlation: 1 if every a exceeds every b, -1 if none does.
    ``p`` is corrected for the number of tests where ``holm`` was applied.
    """

    p: float
    effect: float
    n_a: int
    n_b: int


def compare(a: Sequence[float], b: Sequence[float]) -> Comparison:
    """Mann-Whitney U test of ``a`` against ``b``; p = 1 if either is empty or all are equal."""
    if not a or not b or len({*a, *b}) == 1:
        return Comparison(1.0, 0.0, len(a), len(b))
    test = stats.mannwhitneyu(a, b, alternative="two-sided")
    return Comparison(
        float(test.pvalue), float(2.0 * test.statistic / (len(a) * len(b)) - 1.0), len(a), len(b)
    )


def holm(comparisons: Sequence[Comparison]) -> list[Comparison]:
    """The same comparisons with p corrected by Holm's step-down procedure."""
    order = sorted(range(len(comparisons)), key=lambda i: comparisons[i].p)
    corrected = [1.0] * len(comparisons)
    floor = 0.0
    for position, i in enumerate(order):
        floor = max(floor, min(1.0, comparisons[i].p * (len(comparisons) - position)))
        corrected[i] = floor
    return [
        Comparison(p, c.effect, c.n_a, c.n_b) for p, c in zip(corrected, comparisons, strict=True)
    ]
