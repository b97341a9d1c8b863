"""Integration step of the contact: errors, chatter, table and figures."""

from __future__ import annotations

import importlib
from dataclasses import replace

import numpy as np
import pytest
from made_up_results import Result, made_up
from records import synthetic_record

from apnc.studies.runner import grid_of
from apnc_core.types import Array
from apnc_plant.robot import load_robot
from apnc_plant.step import own_step
from research import contact
from research.contact.measure import STEPS, Trot, chatter, errors, touch_down
from research.registry import STUDIES

LILIBOT = load_robot("lilibot")


def test_contact_varies_damping_depth_and_step() -> None:
    cells = {
        (t.experiment.description.contact.damping_depth, round(1 / 60 / t.experiment.step))
        for t in grid_of("contact", 1, studies=STUDIES)
    }
    depths = (LILIBOT.contact.damping_depth, 1e-6)
    assert cells == {(depth, n) for depth in depths for n in (12, 24, 48, 96, 192)}
    assert depths[0] == contact.GRADUAL and depths[1] == contact.SUDDEN


def test_a_step_that_no_error_is_known_of_is_refused() -> None:
    with pytest.raises(ValueError, match="steps '9' is not one of 12, 24"):
        grid_of("contact", 1, chosen={"steps": ["9"]}, studies=STUDIES)


def test_chatter_is_the_share_of_loaded_steps_that_turn_round() -> None:
    forces = np.zeros((102, 1, 3))
    forces[:, 0, 2] = 5.0
    assert chatter(forces) == 0.0
    forces[::2, 0, 0] = 1.0
    assert chatter(forces) == 1.0
    forces[:, 0, 0], forces[::2, 0, 1] = 0.0, 0.09  # too small
    assert chatter(forces) == 0.0
    forces[::2, 0, 1] = -1.0
    assert chatter(forces) == 1.0
    forces[51:, 0, 2] = 0.9  # hardly loaded
    forces[:51, 0, 1] = 0.0
    assert chatter(forces) == 0.0


def test_only_lateral_forces_that_turn_sharply_both_ways_chatter() -> None:
    forces = np.zeros((102, 1, 3))
    forces[:, 0, 2] = 1.5  # loaded
    forces[::2, 0, 2] += 1.0  # vertical
    forces[:, 0, 0] = np.cumsum(np.where(np.arange(102) % 2, 1.0, -0.05))
    assert chatter(forces) == 0.0
    forces[::2, 0, 1] = 1.0
    assert chatter(forces) == 1.0


def test_a_force_that_turns_once_does_not_chatter() -> None:
    forces = np.zeros((100, 1, 3))
    forces[:, 0, 2] = 5.0
    forces[50:, 0, 0] = 1.0
    assert chatter(forces) == 0.0


def trot_of(vertical: Array, position: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Trot:
    forces = np.zeros((*vertical.shape, 3))
    forces[..., 2] = vertical
    return Trot(forces, np.array(position))


def test_errors_are_relative_to_the_finest_step() -> None:
    level = np.repeat([[10.0], [20.0], [0.0]], 40, axis=0)  # by tick
    fine = np.repeat(level, 192, axis=0) * np.ones(4)
    coarse = 1.1 * np.repeat(level, 24, axis=0) * np.ones(4)
    found = errors(trot_of(coarse, (1.0, 3e-3, 4e-3)), trot_of(fine, (1.0, 0.0, 0.0)))
    assert found["force_error"] == pytest.approx(0.1)
    assert found["tick_force_error"] == pytest.approx(0.1)
    assert found["peak_N"] == pytest.approx(22.0)
    assert found["distance_error_mm"] == pytest.approx(5.0)
    assert found["chatter"] == 0.0


def test_errors_compare_at_the_ends_of_the_coarsest_steps() -> None:
    ticks = 120
    own = np.full((ticks, 24, 1), 10.0)
    own[:, 0::2] = 14.0  # at the beginning of each of the twelve steps, not at its end
    fine = np.full((ticks * 192, 1), 10.0)
    found = errors(trot_of(own.reshape(-1, 1)), trot_of(fine))
    assert found["force_error"] == 0.0
    assert found["tick_force_error"] == pytest.approx(0.2)  # the mean is 12
    own[:, 1] = 18.0  # at the end of the first of twelve
    found = errors(trot_of(own.reshape(-1, 1)), trot_of(fine))
    assert found["force_error"] == pytest.approx(0.8 / np.sqrt(12.0))


def test_contact_is_measured_with_the_step_of_the_walk(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[float, int]] = []

    def trot(depth: float, steps: int) -> Trot:
        asked.append((depth, steps))
        return trot_of(np.full((120 * steps, 4), 12.0 if steps == 24 else 10.0))

    contact_measure = importlib.import_module("research.contact.measure")
    monkeypatch.setattr(contact_measure, "trot", trot)
    experiment = contact.experiment("apnc", 0, 1e-6, 24)
    record = replace(synthetic_record(30.0), experiment=experiment, wall_s=3.0)
    record = replace(record, robot=experiment.description)
    result = contact_measure.measure(record)
    assert asked == [(1e-6, 24), (1e-6, 192)]
    assert result["step_ms"] == pytest.approx(1e3 / 60 / 24)
    assert result["real_time_factor"] == pytest.approx(10.0)
    assert result["force_error"] == pytest.approx(0.2)
    assert set(result) >= {"peak_N", "tick_force_error", "chatter", "distance_error_mm"}


@pytest.mark.thorough
def test_the_default_step_is_fine_enough_for_forces() -> None:
    contact_measure = importlib.import_module("research.contact.measure")
    steps = round(contact_measure.TICK / own_step(load_robot("lilibot")))
    own, finest = (contact_measure.trot(contact.GRADUAL, n) for n in (steps, STEPS[-1]))
    assert contact.fine_enough(errors(own, finest))
    assert not contact.fine_enough(errors(contact_measure.trot(contact.GRADUAL, STEPS[0]), finest))


def test_the_table_says_which_step_is_fine_enough() -> None:
    result = {"depth": 2e-4, "step_ms": 1.042, "force_error": 0.05, "chatter": 0.01}
    results = [
        result,
        result | {"force_error": 0.051},
        result | {"chatter": 0.011},
        {"depth": 2e-4},
    ]
    lines = contact.table(results).splitlines()[2:]
    assert [line.split(" | ")[-1] for line in lines] == ["yes |", "no |", "no |"]
    assert lines[0].startswith("| 0.2 | 1.042 | - | - | 5.0 | 1.00 |")


def test_touch_down_is_the_first_rise_from_zero() -> None:
    force = np.zeros((400, 2))
    force[:50, 0], force[100:200, 0], force[10:, 1] = 5.0, 7.0, 9.0
    time, shown = touch_down(trot_of(force), 32)
    assert len(time) == len(shown) == 8 + 64
    assert time[8] == 0.0 and shown[8] == 0.0 and shown[9] == 7.0
    assert time[9] == pytest.approx(1e3 / 60 / 32)


def test_contact_shows_error_and_chatter_over_the_step() -> None:
    def figures(cell: Result) -> Result:
        step = 1e3 / 60 / cell["steps"]
        error = 0.0 if cell["steps"] == 192 else 0.1 * step
        return {"step_ms": step, "force_error": error, "chatter": 0.01}

    axes = {"depth": (2e-4, 1e-6), "steps": (12, 192)}
    results = made_up(axes, figures, controllers=("apnc",), seeds=1, study="contact")
    del results[0]["force_error"], results[0]["chatter"]  # ended with an error
    (figure,) = contact.STUDY.figures(results)
    shown = {trace["name"]: trace["x"] for trace in figure.data}
    assert shown["force error, damping depth 0.2 mm"] == []
    assert shown["force error, damping depth 0.001 mm"] == [pytest.approx(1e3 / 60 / 12)]
    assert len(shown["chatter, damping depth 0.001 mm"]) == 2
    assert figure.layout["xaxis"]["type"] == figure.layout["yaxis"]["type"] == "log"
    assert figure.layout["xaxis"]["title"]["text"] == "step [ms]"
    assert figure.layout["yaxis"]["title"]["text"] == "error, chatter [1]"
    assert figure.key == "contact-error" and not figure.over_time
    assert all(trace["mode"] == "lines+markers" for trace in figure.data)


def test_touch_down_is_shown_for_four_laws(monkeypatch: pytest.MonkeyPatch) -> None:
    def trot(depth: float, steps: int) -> Trot:
        forces = np.zeros((600, 4, 3))
        forces[300:, 0, 2] = 1.0
        return Trot(forces, np.zeros(3))

    monkeypatch.setattr(contact, "trot", trot)
    (figure,) = contact.STUDY.scenes("lilibot")
    assert figure.layout["xaxis"]["title"]["text"] == "time from touch-down [ms]"
    assert figure.layout["yaxis"]["title"]["text"] == "vertical force on foot RF [N]"
    assert figure.key == "contact-force" and not figure.over_time
    assert [trace["name"] for trace in figure.data] == [
        "0.0868 ms, damping depth 0.001 mm",
        "0.0868 ms, damping depth 0.4 mm",
        "0.347 ms, damping depth 0.4 mm",
        "0.694 ms, damping depth 0.4 mm",
    ]
