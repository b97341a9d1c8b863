"""Figures of strides and feet in a part of a run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from records import LIFT, synthetic_record

from apnc import metrics
from apnc.feet import Feet

RECORD = synthetic_record(20.0, frequency=1.5, duty=0.6, speed=0.09)
LATE = slice(600, None)


def test_figures_of_a_known_walk() -> None:
    feet = Feet(RECORD)
    assert feet.stride_frequency == pytest.approx(1.5)
    assert feet.stride_length == pytest.approx(0.06, rel=0.01)
    assert feet.duty_factors == pytest.approx([0.6] * 4, abs=0.03)
    assert feet.touch_downs == pytest.approx([1.0] * 4)
    assert feet.lifts == pytest.approx([LIFT] * 4, rel=0.05)
    assert feet.standing.shape == (len(RECORD), 4) and len(feet.starts) == 4


def test_only_the_samples_of_the_part_count() -> None:
    """Feet that stamp in the first half: the second half has the figures of a clean walk."""
    feet, force = (RECORD.signals[name].copy() for name in ("foot_position", "foot_force"))
    down = np.arange(LATE.start) // 4 % 2 == 0
    feet[: LATE.start, :, 0] += np.where(down, 0.01, 0.0)[:, None]
    feet[: LATE.start, :, 2] = 0.012
    force[: LATE.start, :, 2] = np.where(down, 20.0, 0.0)[:, None]
    signals = {**RECORD.signals, "foot_position": feet, "foot_force": force}
    stamped = replace(RECORD, signals=signals)
    clean, whole, late = Feet(RECORD, LATE), Feet(stamped), Feet(stamped, LATE)
    for name in ("duty_factors", "touch_downs", "lifts", "slips"):
        assert getattr(late, name) == getattr(clean, name)
        assert getattr(late, name) != getattr(whole, name)
    assert (late.stride_frequency, late.stride_length) == pytest.approx(
        (Feet(RECORD).stride_frequency, Feet(RECORD).stride_length), rel=0.01
    )


def test_stance_is_that_of_the_whole_run() -> None:
    """A part in which the feet hardly press has no threshold of its own."""
    force = RECORD.signals["foot_force"].copy()
    force[LATE] *= 1e-3
    light = replace(RECORD, signals={**RECORD.signals, "foot_force": force})
    assert not Feet(light, LATE).standing[3:].any()
    assert metrics.stance(force[LATE, :, 2]).any()


def test_coordination_is_undefined_for_a_robot_that_stands() -> None:
    assert Feet(RECORD).coordination(0.0) is None


def test_a_part_without_samples_has_no_figures() -> None:
    feet = Feet(RECORD, slice(0, 0))
    assert (feet.stride_frequency, feet.stride_length) == (None, None)
    for figures in (feet.duty_factors, feet.touch_downs, feet.lifts, feet.slips):
        assert list(figures) == [None] * 4
