"""The MI range of a tuned robot is where its walks of a check are good."""

from __future__ import annotations

from dataclasses import replace

import pytest

from apnc.tune.measured import Measured
from apnc.tune.span import found_range

GOOD = Measured("walk", 0.0, 1.0, True, 2.0, 0.3, 0.0, 0.15, 0.08, 0.10, 0.0, 0.0, 0.0, 1.0)
RANGE = (0.08, 0.32)
COUNT = 11
SEEDS = 10


def check(bad: dict[tuple[str, int], dict[str, object]]) -> list[Measured]:
    """Runs at eleven even steps; some of them differ from a good one, by kind and step."""
    return some({where: (SEEDS, what) for where, what in bad.items()})


def some(bad: dict[tuple[str, int], tuple[int, dict[str, object]]]) -> list[Measured]:
    """The same, with only so many bad ones of all seeds."""
    return [
        replace(GOOD, kind=kind, share=k / (COUNT - 1), **(what if seed < count else {}))
        for kind in ("walk", "apc")
        for k in range(COUNT)
        for count, what in [bad.get((kind, k), (0, {}))]
        for seed in range(SEEDS)
    ]


def mi(step: int) -> float:
    return 0.08 * 4.0 ** (step / (COUNT - 1))


def test_the_whole_range_where_all_is_good() -> None:
    assert found_range(RANGE, check({})) == RANGE


def test_ends_at_which_the_gait_does_not_form_are_left_out() -> None:
    bad = {
        ("walk", 0): {"strict": False},
        ("apc", 1): {"strict": False},
        ("apc", 10): {"lift": 0.0},
    }
    assert found_range(RANGE, check(bad)) == pytest.approx((mi(2), mi(9)), rel=1e-2)


def test_feet_that_slip_more_than_aimed_at_are_left_out_while_enough_is_left() -> None:
    slips = {"slip": 0.22}
    assert found_range(RANGE, check({("walk", 0): slips}))[0] == pytest.approx(mi(1), rel=1e-2)
    everywhere = {("walk", k): slips for k in range(COUNT)}
    assert found_range(RANGE, check(everywhere)) == RANGE


def test_feet_and_walks_without_couplings_count_as_the_aims_count_them() -> None:
    low, fails = {"lift": 0.04}, {"strict": False}
    assert found_range(RANGE, some({("walk", 0): (4, low), ("apc", 5): (1, fails)})) == RANGE
    for where, count, what in (("walk", 6, low), ("walk", 1, fails), ("apc", 2, fails)):
        found = found_range(RANGE, some({(where, 0): (count, what)}))
        assert found[0] == pytest.approx(mi(1), rel=1e-2), (where, what)


def test_a_range_ends_where_every_walk_is_good_while_enough_is_left() -> None:
    fails = {"strict": False}
    bad = {("apc", 0): (1, fails), ("apc", 1): (1, fails), ("apc", 10): (1, fails)}
    assert found_range(RANGE, some(bad)) == pytest.approx((mi(2), mi(9)), rel=1e-2)
    everywhere = {("apc", k): (1, fails) for k in range(COUNT)}
    low, high = found_range(RANGE, some(everywhere))
    assert high / low == pytest.approx(4.0**0.5, rel=1e-2)


def test_a_range_that_is_narrow_already_stays() -> None:
    bad = check({("walk", 0): {"strict": False}})
    assert found_range((0.15, 0.25), bad) == (0.15, 0.25)


def test_the_longer_of_two_parts() -> None:
    assert found_range(RANGE, check({("walk", 3): {"strict": False}})) == pytest.approx(
        (mi(4), mi(10)), rel=1e-2
    )


def test_couplings_alone_are_better_than_nothing() -> None:
    alone = {("apc", k): {"strict": False} for k in range(COUNT)}
    assert found_range(RANGE, check(alone | {("walk", 0): {"strict": False}})) == pytest.approx(
        (mi(1), mi(10)), rel=1e-2
    )


def test_less_than_half_is_no_range() -> None:
    fails = {"strict": False}
    bad = {("walk", k): fails for k in range(0, COUNT, 3)}
    assert found_range(RANGE, check(bad)) == RANGE
