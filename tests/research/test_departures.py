"""Departures taken back one by one: the grid, and the table of made-up results."""

from __future__ import annotations

from dataclasses import replace

import pytest
from made_up_results import Result, made_up
from records import synthetic_record

from apnc.studies.runner import grid_of
from apnc.studies.states.timeline import TIMELINE
from apnc_plant.robot import load_robot
from research import departures
from research.departures import ADDED, NONE, POSE, PRINTED, REMOVED, STATES
from research.registry import STUDIES


def test_every_departure_of_the_table_is_taken_back_once() -> None:
    taken = [name for names in REMOVED.values() for name in names]
    assert sorted(taken) == sorted([*PRINTED, *ADDED])


def test_trials_differ_in_what_is_taken_back_alone() -> None:
    printed = {**PRINTED, **ADDED}
    for trial in grid_of("departures", 1, studies=STUDIES):
        settings = trial.experiment.settings
        assert dict(settings) == dict(REMOVED[trial.cell["removed"]])
        assert all(settings[name] == printed[name] for name in settings)
        if trial.cell["removed"] == POSE:
            assert trial.experiment.robot == departures.posed(load_robot("lilibot"))
        else:
            assert trial.experiment.robot == "lilibot"
        if trial.cell["task"] == STATES:
            assert trial.experiment.mi == TIMELINE.experiment("apnc", 0).mi
        else:
            assert trial.cell["task"] in (f"MI {trial.experiment.mi}", "C3", "C4")
            named = trial.cell["task"].startswith("C")
            assert trial.experiment.conditions == (trial.cell["task"] if named else "C1")
            assert trial.experiment.duration == 25.0


def test_only_the_run_through_the_states_is_judged_by_them() -> None:
    assert departures.measure(synthetic_record(20.0)) == {}


@pytest.mark.parametrize("moves", [True, False])
def test_a_stop_is_one_if_no_oscillator_moves_before_the_restart(moves: bool) -> None:
    record = synthetic_record(TIMELINE.end)
    o1 = record.signals["o1"].copy()
    time = record.time
    o1[(time >= TIMELINE.stopped) & (time < TIMELINE.restarted), 0 if moves else slice(None)] = 0.1
    run = replace(
        record,
        experiment=TIMELINE.experiment("apnc", 0),
        signals={**record.signals, "o1": o1},
    )
    assert departures.measure(run)[departures.STOP_MOVES] is moves


def test_the_table_counts_trots_and_states() -> None:
    def figures(cell: Result) -> Result:
        lost = cell["removed"] != NONE and cell["seed"] == 0
        if cell["task"] == STATES:
            states = {"state_S1": True, "state_S2": not lost, "state_S3": False}
            return states | {departures.STOP_MOVES: lost}
        return {"convergence_time_s": None if lost else 2.0, "late_speed_m_per_s": 0.1}

    first = list(REMOVED)[:2]
    axes = {"removed": first, "task": (*departures.WALKS, STATES)}
    results = made_up(axes, figures, controllers=("apnc",), study="departures")
    lines = departures.table(results).splitlines()[2:]
    assert lines[0].startswith(
        f"| {NONE} | 6/6 | 6/6 | 6/6 | 6/6 | 6/6 | 6/6 | 6/6 | 0.100 (0.100 ... 0.100) |"
    )
    assert lines[0].endswith("| 6/6 | 6/6 | 0/6 | 6/6 |")
    assert "| 5/6 | 5/6 | 5/6 | 5/6 | 5/6 | 5/6 | 5/6 |" in lines[1]
    assert lines[1].endswith("| 6/6 | 5/6 | 0/6 | 5/6 |")


def test_the_published_pose_is_that_of_the_authors_and_of_every_leg() -> None:
    posed = departures.posed(load_robot("lilibot"))
    for leg in posed.legs:
        assert (leg.femur_angle, leg.tibia_angle) == pytest.approx((0.7505, 1.6057), abs=1e-4)
