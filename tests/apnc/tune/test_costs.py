"""What a cost must not pay for: falling in place of standing, and marching on the spot."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from apnc.tune.costs import MILD, NEAR, OF_PAPER, USUAL, Weights, cost_of
from apnc.tune.measured import MAX_SLIP, MIN_LIFT, MIN_SPEED, Measured

WALK = Measured(
    kind="walk", share=0.5, fell=1.0, strict=True, time=2.0, mean_error=0.2, end_error=0.0,
    speed=0.12, lift=0.07, slip=0.1, feet=0.1, turning=0.0, saturated=0.0, transport=1.0,
)  # fmt: skip
KINDS = ("walk", "apc", "varied", "payload", "sensor", "air", "states", "turns", "damage", "rate")


def fallen(kind: str, at: float) -> Measured:
    return replace(
        WALK, kind=kind, fell=at, strict=False, mean_error=np.pi, end_error=1.5, speed=0.0,
        lift=0.0, slip=1.0, feet=4.0,
    )  # fmt: skip


@pytest.mark.parametrize("weights", [USUAL, NEAR, OF_PAPER])
@pytest.mark.parametrize("kind", KINDS)
def test_a_fall_costs_more_than_whatever_a_robot_does_that_stays_up(
    kind: str, weights: Weights
) -> None:
    # every measure at its worst, one after the other and all together
    worst = {
        "strict": False, "mean_error": np.pi, "end_error": 1.5, "speed": -1.0, "feet": 4.0,
        "turning": -30.0, "saturated": 1.0, "transport": 1e4,
    }  # fmt: skip
    latest = cost_of(fallen(kind, 0.999), weights)
    for chosen in product((False, True), repeat=len(worst)):
        changed = {name: worst[name] for name, on in zip(worst, chosen, strict=True) if on}
        run = replace(WALK, kind=kind, **changed)  # type: ignore[arg-type]
        assert cost_of(run, weights) < latest
    early, at_once = (cost_of(fallen(kind, at), weights) for at in (0.5, 0.0))
    assert latest < early < at_once


def test_a_worse_run_costs_more_also_where_costs_are_large() -> None:
    costs = [
        cost_of(replace(WALK, strict=False, end_error=0.5, feet=feet, mean_error=3.0))
        for feet in (0.0, 0.5, 1.0, 2.0, 4.0)
    ]
    assert costs[0] < MILD < costs[-1]
    assert costs == sorted(set(costs))


def test_near_a_tuned_robot_one_foot_below_the_aim_counts() -> None:
    for worse in (replace(WALK, lift=0.045), replace(WALK, slip=0.2)):
        assert cost_of(worse, NEAR) > cost_of(WALK, NEAR) + 0.4
        assert cost_of(worse) == cost_of(WALK)
    assert cost_of(WALK, NEAR) == cost_of(WALK)


def test_a_gait_on_the_spot_or_on_dragging_feet_is_not_good() -> None:
    assert WALK.good
    for name, limit, worse in (
        ("speed", MIN_SPEED, 0.0),
        ("lift", MIN_LIFT, 0.0),
        ("slip", MAX_SLIP, 1.0),
    ):
        spoiled = replace(WALK, **{name: worse})
        assert spoiled.strict and not spoiled.good
        assert replace(WALK, **{name: limit}).good
        assert cost_of(spoiled) > cost_of(WALK)
    assert not replace(WALK, strict=False).good
    assert not replace(WALK, fell=0.99).good
