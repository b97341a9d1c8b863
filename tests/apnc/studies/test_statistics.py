"""Intervals and tests against closed forms."""

from __future__ import annotations

import math

import pytest

from apnc.studies.statistics import (
    Comparison,
    compare,
    compare_rates,
    compare_spread,
    holm,
    median,
    p_text,
    rank_correlation,
    rate,
)


def test_rate_interval_is_exact() -> None:
    # Clopper-Pearson at 0 and n of n in closed form
    none, every = rate([False] * 20), rate([True] * 20)
    assert (none.low, none.high) == (0.0, pytest.approx(1 - 0.025 ** (1 / 20)))
    assert (every.low, every.high) == (pytest.approx(0.025 ** (1 / 20)), 1.0)
    assert (none.value, every.value) == (0.0, 1.0)


def test_rate_counts_successes() -> None:
    part = rate([True, False, True, True])
    assert (part.successes, part.trials, part.value) == (3, 4, 0.75)
    assert str(part) == "3/4 (19 ... 99 %)"


def test_rate_of_nothing_is_unknown() -> None:
    assert rate([])[:] == (0, 0, 0.0, 1.0)
    assert math.isnan(rate([]).value)


def test_median_and_its_interval() -> None:
    result = median([float(i) for i in range(101)])
    assert result.value == 50.0 and result.size == 101
    # the interval of the order statistics 40 and 62 covers the median with 95 %
    assert result.low == pytest.approx(40.0, abs=2.0)
    assert result.high == pytest.approx(60.0, abs=2.0)
    assert median([float(i) for i in range(101)]) == result  # a fixed seed


def test_median_of_one_value_and_of_equal_ones_is_sure() -> None:
    assert median([3.0]) == (3.0, 3.0, 3.0, 1)
    assert median([3.0, 3.0]) == (3.0, 3.0, 3.0, 2)
    assert median([3.0, 5.0])[:] == (4.0, 3.0, 5.0, 2)


def test_median_of_nothing() -> None:
    assert median([]).size == 0
    assert all(math.isnan(value) for value in median([])[:3])


def test_median_as_text() -> None:
    assert median([]).text() == "-"
    assert median([0.125]).text(2, "m/s") == "0.12 (0.12 ... 0.12) m/s"
    assert median([1.0]).text() == "1.00 (1.00 ... 1.00)"
    assert median([1.0]).text(1, "s", 1) == "1.0 (1.0 ... 1.0) s, n = 1"
    assert median([1.0]).text(1, "s", 20) == "1.0 (1.0 ... 1.0) s, n = 1 of 20"
    assert median([]).text(runs=20) == "-, n = 0 of 20"


def test_effect_is_signed_and_complete() -> None:
    low, high = [1.0, 2.0, 3.0, 4.0], [11.0, 12.0, 13.0, 14.0]
    assert compare(high, low) == (pytest.approx(2 / 70), 1.0)  # 2 of the C(8, 4) orders
    assert compare(low, high).effect == -1.0
    # a exceeds b in 3 of 4 pairs, falls short in 1
    assert compare([2.0, 4.0], [1.0, 3.0]).effect == pytest.approx(0.5)


@pytest.mark.parametrize(("a", "b"), [([], [1.0]), ([1.0], []), ([1.0, 1.0], [1.0])])
def test_nothing_to_compare(a: list[float], b: list[float]) -> None:
    assert compare(a, b) == (1.0, 0.0)


def test_rank_correlation() -> None:
    up = rank_correlation([1.0, 2.0, 3.0, 4.0, 5.0], [1.0, 4.0, 9.0, 16.0, 25.0])
    assert up is not None and up.effect == pytest.approx(1.0) and up.p < 0.05
    # rho = 1 - 6 sum d^2 / (n (n^2 - 1)) = 1 - 6 * 2 / 60
    swap = rank_correlation([1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 4.0, 3.0])
    assert swap is not None and swap.effect == pytest.approx(0.8) and swap.p > 0.05


@pytest.mark.parametrize(
    ("x", "y"), [([1, 2], [1, 2]), ([1, 1, 1], [1, 2, 3]), ([1, 2, 3], [5] * 3)]
)
def test_too_few_to_correlate(x: list[float], y: list[float]) -> None:
    assert rank_correlation(x, y) is None


def test_three_pairs_are_enough() -> None:
    assert rank_correlation([1, 2, 2], [1, 2, 2]) is not None


def test_rates_differ_by_fishers_exact_test() -> None:
    # all of 5 against none of 5: two of the C(10, 5) tables are as far apart
    test = compare_rates(rate([True] * 5), rate([False] * 5))
    assert test == (pytest.approx(2 / 252), -1.0)
    assert compare_rates(rate([True, False]), rate([True, False])) == (1.0, 0.0)
    assert compare_rates(rate([]), rate([True])) == (1.0, 0.0)


def test_spread_is_that_around_the_median() -> None:
    wide, narrow = [0.0, 5.0, 10.0, 15.0, 20.0], [9.0, 9.5, 10.0, 10.5, 11.0]
    test = compare_spread(narrow, wide)
    assert test.p < 0.05 and test.effect == pytest.approx(9 / 11)  # ten times as wide
    assert compare_spread(wide, narrow).effect == pytest.approx(-9 / 11)
    shifted = [value + 100.0 for value in narrow]
    assert compare_spread(narrow, shifted) == (pytest.approx(1.0), pytest.approx(0.0))
    assert compare_spread([1.0, 1.0], [1.0, 1.0]) == (1.0, 0.0)


def test_holm_steps_down() -> None:
    ps = [0.01, 0.04, 0.03, 0.005, 0.9]
    corrected = holm([Comparison(p, 0.5) for p in ps])
    assert [test.p for test in corrected] == pytest.approx([0.04, 0.09, 0.09, 0.025, 0.9])
    assert {test.effect for test in corrected} == {0.5}


def test_holm_ends_at_one() -> None:
    assert [test.p for test in holm([Comparison(0.6, 0.0), Comparison(0.7, 0.0)])] == [1.0, 1.0]


@pytest.mark.parametrize(
    ("p", "text"),
    [
        (1.0, "p = 1"),
        (0.9999, "p = 1"),
        (0.0416, "p = 0.042"),
        (1e-3, "p = 0.001"),
        (9e-4, "p < 0.001"),
        (0.0, "p < 0.001"),
    ],
)
def test_a_p_is_told_in_two_digits(p: float, text: str) -> None:
    assert p_text(p) == text
