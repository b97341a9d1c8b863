"""Forward models: the grid, the gain of Eq. 9 and the claims."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from made_up_results import Result, made_up
from records import synthetic_record

from apnc.loop.record import End, Record
from apnc.studies.claims import NO, PARTLY, YES
from apnc.studies.results import AUTHORS, STRICT
from apnc.studies.runner import grid_of
from apnc_core.enumerations import ForwardModel
from research import forward_model
from research.registry import STUDIES


def test_forward_models_differ_in_nothing_else() -> None:
    trials = grid_of("forward_model", 2, studies=STUDIES)
    assert Counter((t.cell["controller"], t.cell["model"], t.cell["mi"]) for t in trials) == {
        ("apnc", model.name, mi): 2 for model in ForwardModel for mi in (0.08, 0.15, 0.24)
    }
    for trial in trials:
        parameters = trial.experiment.parameters()
        assert parameters["forward_model"] == ForwardModel[trial.cell["model"]]
        assert trial.experiment.duration == 25.0
        assert set(trial.experiment.settings) == {"forward_model"}


def learned(stored: float, duration: float = 25.0) -> Record:
    """A walk whose K_f + K_s is 0.1 on half of the legs until kappa = 1, and 0.02 on all after."""
    base = synthetic_record(duration)
    on = base.time >= stored
    K = np.where(on[:, None], 0.01, [0.05, 0.0, 0.05, 0.0])
    experiment = replace(base.experiment, duration=duration)
    signals = {**base.signals, "K_f": K, "K_s": K, "kappa": 1.0 * on}
    return replace(base, experiment=experiment, signals=signals)


def test_the_gain_is_that_of_equation_9_before_and_late() -> None:
    found = forward_model.measure(learned(6.0))
    assert found == pytest.approx({"gain_forming": 0.05, "gain_late": 0.02})


@pytest.mark.parametrize("stored", [0.0, 21.0, 99.0])
def test_no_gain_without_a_before_and_a_late_part(stored: float) -> None:
    assert forward_model.measure(learned(stored)) == {"gain_forming": None, "gain_late": None}


def test_no_gain_of_a_run_that_fell() -> None:
    fell = replace(learned(6.0), end=End.fell)
    assert forward_model.measure(fell) == {"gain_forming": None, "gain_late": None}


def of_models(**figures: Any) -> list[Result]:
    """Walks with every forward model; a figure is a number, or a function of the cell."""
    axes = {"model": tuple(forward_model.MODELS), "mi": (0.08, 0.15)}
    return made_up(
        axes,
        lambda cell: {k: v(cell) if callable(v) else v for k, v in figures.items()},
        ("apnc",),
        study="forward_model",
    )


@pytest.mark.parametrize("model", ["low_pass_knee", "radial_basis"])
@pytest.mark.parametrize(
    ("failing", "expected"), [(0, YES), (1, PARTLY), (6, NO)], ids=["none", "one", "half"]
)
def test_a_forward_model_forms_the_gait(model: str, failing: int, expected: str) -> None:
    def time(cell: Result) -> float | None:
        lost = cell["model"] == model and cell["mi"] == 0.15 and cell["seed"] < failing
        return None if lost else 2.0

    results = of_models(**{STRICT: time, AUTHORS: time})
    assert forward_model.forms(model)(results).verdict == expected
    other = "radial_basis" if model == "low_pass_knee" else "low_pass_knee"
    assert forward_model.forms(other)(results).verdict == YES


@pytest.mark.parametrize(
    ("late", "expected"), [(0.02, YES), (0.08, PARTLY), (0.12, NO), (None, NO)]
)
def test_the_gain_falls_of_itself(late: float | None, expected: str) -> None:
    results = of_models(
        gain_forming=0.1, gain_late=lambda c: late if c["model"] == "radial_basis" else 0.02
    )
    assert forward_model.gain_falls("radial_basis")(results).verdict == expected
    assert forward_model.gain_falls("low_pass_hip")(results).verdict == YES


def test_the_figures_of_the_forward_models_are_told() -> None:
    results = of_models(gain_forming=0.1, gain_late=0.025)
    assert forward_model.gain_falls("radial_basis")(results).measured == (
        "0.100 (0.100 ... 0.100), late 0.025 (0.025 ... 0.025), ratio 0.25 (0.25 ... 0.25), n = 12"
    )
    results = of_models(**{STRICT: 2.0, AUTHORS: None})
    assert forward_model.forms("radial_basis")(results).measured == (
        "strict: 12/12 (74 ... 100 %), 2.0 (2.0 ... 2.0) s, with the hip's 2.0 (2.0 ... 2.0) s; "
        "authors': 0/12 (0 ... 26 %), -, with the hip's -"
    )
