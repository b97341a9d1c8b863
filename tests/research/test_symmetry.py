"""Equal loads: the grid, the measure and the verdict."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from made_up_results import Result, made_up
from records import TROT, outputs, synthetic_record

from apnc.loop.record import Record
from apnc.studies.claims import FEW, NO, PARTLY, YES
from apnc.studies.results import STRICT
from apnc.studies.runner import grid_of
from apnc_plant.robot import load_robot
from research import symmetry
from research.registry import STUDIES


def test_equal_loads_are_walked_once_per_mi() -> None:
    trials = grid_of("symmetry", 20, studies=STUDIES)
    assert [t.experiment.mi for t in trials] == [0.08, 0.12, 0.16, 0.2, 0.24]
    for trial in trials:
        robot = trial.experiment.description
        assert robot.trunk.com_side_offset == robot.sensor.noise == 0.0
        assert robot.mass == load_robot("lilibot").mass and not trial.experiment.settings


def in_phase_until(parted: float, duration: float = 34.0) -> Record:
    """A walk whose legs have one phase until then, and trot."""
    base = synthetic_record(duration)
    lead = np.zeros((len(base.time), 4))
    lead[base.time >= parted, 1:] = TROT
    o1, o2 = outputs(2 * np.pi * 1.4 * base.time[:, None] + lead)
    return replace(base, signals={**base.signals, "o1": o1, "o2": o2})


def test_legs_part_when_one_leaves_the_phase_of_another() -> None:
    assert symmetry.measure(synthetic_record(20.0))["parted_at_s"] == pytest.approx(0.0)
    later = in_phase_until(5.0)
    # the phases are smoothed over 1.5 s
    assert symmetry.measure(later)["parted_at_s"] == pytest.approx(5.0, abs=0.8)
    assert symmetry.measure(in_phase_until(99.0))["parted_at_s"] is None


def apart(*parted: float | None) -> list[Result]:
    """When the legs of the symmetric robot part, by MI."""
    cells = {"mi": tuple(0.08 + 0.04 * i for i in range(len(parted)))}
    results = made_up(cells, lambda _: {}, controllers=("apnc",), seeds=1, study="symmetry")
    return [r | {symmetry.PARTED: t, STRICT: t} for r, t in zip(results, parted, strict=True)]


@pytest.mark.parametrize(
    ("parted", "expected"),
    [
        ((None, None, None, None), YES),
        ((None, 3.0, 3.0, 3.0), PARTLY),
        ((3.0, 3.0, 3.0, 3.0), NO),
        ((None, None), FEW),
    ],
)
def test_the_verdict_counts_the_walks_that_stay_in_phase(
    parted: tuple[float | None, ...], expected: str
) -> None:
    assert symmetry.in_phase(apart(*parted)).verdict == expected


def test_what_was_measured_is_told() -> None:
    assert symmetry.in_phase(apart(None, 3.0, 5.0)).measured == (
        "together in 1 of 3; parted after 4.0 (3.0 ... 5.0) s, n = 2 of 3; "
        "trot after 4.0 (3.0 ... 5.0) s, n = 2 of 3"
    )
