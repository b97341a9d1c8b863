"""Equal loads: the robot, the measures and the verdict."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from made_up_results import Result, made_up
from records import TROT, outputs, synthetic_record

from apnc.loop.record import Record
from apnc.loop.simulate import plant_of
from apnc.studies.claims import FEW, NO, PARTLY, YES
from apnc.studies.results import STRICT
from apnc.studies.runner import grid_of, run_trials
from apnc.studies.study import Trial
from research import symmetry
from research.registry import STUDIES


def grid(duration: float | None = None) -> list[Trial]:
    return grid_of("symmetry", 20, duration=duration, studies=STUDIES)


def test_the_shipped_robot_is_walked_once_per_mi() -> None:
    trials = grid()
    assert [t.experiment.mi for t in trials] == [0.08, 0.12, 0.16, 0.2, 0.24]
    for trial in trials:
        robot = trial.experiment.description
        assert robot.trunk.com_side_offset > 0.0 < robot.sensor.noise
        assert not trial.experiment.settings and not trial.in_c


def test_all_sensors_show_the_mean_of_the_loads() -> None:
    (trial, *_) = grid()
    one, own = symmetry.plant(trial.experiment), plant_of(trial.experiment)
    for hip in (0.0, 0.1, -0.1, 0.2):
        for plant in (one, own):
            plant.advance(np.array([hip, 0.0, 0.0, 0.0]), np.zeros(4), 0.2)
        assert np.ptp(own.grf()) > 0.1
        np.testing.assert_allclose(one.grf(), own.grf().mean(), rtol=1e-12)


def test_the_study_walks_the_robot_with_equal_loads() -> None:
    result = next(run_trials(grid(duration=4.0)[-1:]))
    assert result["error"] == "" and result["gait"] != "trot"
    assert result[symmetry.APART] == result[symmetry.STORED] == 0.0


def in_phase_until(parted: float, kappa: float, duration: float = 34.0) -> Record:
    """A walk whose legs have one phase until then, and trot."""
    base = synthetic_record(duration)
    lead = np.zeros((len(base.time), 4))
    lead[base.time >= parted, 1:] = TROT
    o1, o2 = outputs(2 * np.pi * 1.4 * base.time[:, None] + lead)
    stored = kappa * (base.time >= parted)
    return replace(base, signals={**base.signals, "o1": o1, "o2": o2, "kappa": stored})


def test_the_largest_phase_and_kappa_are_measured() -> None:
    later, never = in_phase_until(5.0, 1.0), in_phase_until(99.0, 1.0)
    assert symmetry.measure(later) == {
        symmetry.APART: pytest.approx(np.pi), symmetry.STORED: 1.0
    }  # fmt: skip
    assert symmetry.measure(never) == {
        symmetry.APART: pytest.approx(0.0, abs=1e-9), symmetry.STORED: 0.0
    }  # fmt: skip


def results(*found: tuple[float | None, float, float | None]) -> list[Result]:
    """Results with these largest phases, largest kappas and times of a trot, by MI."""
    cells = {"mi": tuple(0.08 + 0.04 * i for i in range(len(found)))}
    names = (symmetry.APART, symmetry.STORED, STRICT)
    base = made_up(cells, lambda _: {}, controllers=("apnc",), seeds=1, study="symmetry")
    return [r | dict(zip(names, each, strict=True)) for r, each in zip(base, found, strict=True)]


STAYS = (0.1, 0.0, None)


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        ((STAYS,) * 4, YES),
        ((STAYS, STAYS, STAYS, (0.7, 0.0, None)), PARTLY),
        ((STAYS, STAYS, STAYS, (0.1, 1.0, None)), PARTLY),
        ((STAYS, STAYS, STAYS, (0.1, 0.0, 3.0)), PARTLY),
        (((3.0, 1.0, 3.0),) * 4, NO),
        (((None, 0.0, None),) * 4, NO),
        ((STAYS, STAYS), FEW),
    ],
)
def test_the_verdict_counts_the_walks_that_stay_in_phase(
    found: tuple[tuple[float | None, float, float | None], ...], expected: str
) -> None:
    assert symmetry.in_phase(results(*found)).verdict == expected


def test_what_was_measured_is_told() -> None:
    assert symmetry.in_phase(results(STAYS, STAYS, (3.0, 1.0, 4.0))).measured == (
        "in phase in 2 of 3; largest phase of a leg 3 rad; largest kappa 1; a trot in 1 of 3"
    )
