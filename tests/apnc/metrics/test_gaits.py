"""The table of gaits against their definitions by pairs of legs and order of touch-down."""

from __future__ import annotations

import numpy as np
import pytest
from records import HEXAPOD, OCTOPOD, QUADRUPED, TRIPOD, TROT

from apnc import metrics

LEGS = {4: QUADRUPED, 6: HEXAPOD, 8: OCTOPOD}


def touch_downs(n: int, name: str) -> list[set[str]]:
    """Legs in the order in which they touch down, those at the same time together."""
    late = np.round(-np.array([0.0, *metrics.GAITS[n][name]]) / (2 * np.pi) % 1.0, 9) % 1.0
    legs = dict(zip(LEGS[n], late, strict=True))
    return [{leg for leg in legs if legs[leg] == when} for when in sorted(set(legs.values()))]


@pytest.mark.parametrize(
    ("n", "name", "order"),
    [
        (4, "trot", "RF+LH LF+RH"),
        (4, "pace", "RF+RH LF+LH"),
        (4, "bound", "RF+LF RH+LH"),
        (4, "walk", "RF LH LF RH"),
        (4, "pronk", "RF+RH+LF+LH"),
        (6, "tripod", "RF+RH+LM LF+LH+RM"),
        (6, "tetrapod", "RF+LM RH+LF RM+LH"),
        (6, "wave", "RF LH LM LF RH RM"),
        (6, "direct wave of pairs", "RF+LF RH+LH RM+LM"),
        (6, "retrograde wave of pairs", "RF+LF RM+LM RH+LH"),
        (8, "direct wave of pairs", "RF+LF RH+LH RB+LB RA+LA"),
        (8, "retrograde wave of pairs", "RF+LF RA+LA RB+LB RH+LH"),
        (6, "ripple", "RF LM RH LF RM LH"),
        (6, "pronk", "RF+RM+RH+LF+LM+LH"),
        (8, "alternating tetrapod", "RF+RB+LA+LH RA+RH+LF+LB"),
        (8, "pronk", "RF+RA+RB+RH+LF+LA+LB+LH"),
    ],
)
def test_order_of_touch_downs(n: int, name: str, order: str) -> None:
    assert touch_downs(n, name) == [set(legs.split("+")) for legs in order.split()]


@pytest.mark.parametrize("n", [4, 6])
def test_legs_of_a_gait_are_evenly_spaced(n: int) -> None:
    name = {4: "walk", 6: "wave"}[n]
    late = np.sort(np.array([0.0, *metrics.GAITS[n][name]]) % (2 * np.pi))
    assert np.diff(late) == pytest.approx(2 * np.pi / n)


def test_target_and_its_name() -> None:
    assert metrics.default_target(4) == TROT and metrics.gait_name(4) == "trot"
    assert metrics.default_target(6) == TRIPOD and metrics.gait_name(6) == "tripod"
    assert metrics.gait_name(8) == "alternating tetrapod"
    assert metrics.default_target(10) is None and metrics.gait_name(10) == "gait"


@pytest.mark.parametrize("n", metrics.GAITS)
def test_nearest_gait_of_each(n: int) -> None:
    for name, phases in metrics.GAITS[n].items():
        off = np.array(phases) + 0.3 * (-1.0) ** np.arange(n - 1) - 4 * np.pi
        assert metrics.nearest_gait(off, 0.31) == name
        assert metrics.nearest_gait(off, 0.29) is None


def test_nearest_gait_is_the_nearer_of_two() -> None:
    trot, walk = (np.array(metrics.GAITS[4][name]) for name in ("trot", "walk"))
    between = trot + 0.4 * metrics.wrap(walk - trot)
    assert metrics.nearest_gait(between, 3.0) == "trot"


def test_no_gait_without_phases_or_without_a_table() -> None:
    assert metrics.nearest_gait([np.nan, np.pi, 0.0], 0.6) is None
    assert metrics.nearest_gait([np.pi], 0.6) is None
