"""What the log says of the controller and of the foot sensors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import apnc
from apnc.loop.record import End
from apnc.report.diagnostics import Severity, events, statuses


@pytest.fixture(scope="module")
def record() -> apnc.Record:
    """A run whose couplings are on from tick 3 to 5, and whose sensor of LF fails at tick 4."""
    walked = apnc.simulate(apnc.Experiment(duration=0.2, engine="compiled"))
    kappa, fault = np.zeros(len(walked)), np.zeros((len(walked), 4))
    kappa[3:6] = 1.0
    fault[4:7, 2] = 1.0
    return replace(walked, signals={**walked.signals, "kappa": kappa, "fault": fault})


def test_events_come_in_order_with_the_tick_at_which_they_happen(record: apnc.Record) -> None:
    found = [(event.tick, event.severity) for event in events(record)]
    assert found == [
        (3, Severity.info),
        (4, Severity.error),
        (6, Severity.info),
        (7, Severity.info),
    ]
    assert "foot sensor of LF" in events(record)[1].text


def test_what_is_on_at_the_first_tick_is_an_event(record: apnc.Record) -> None:
    assert [event.tick for event in events(record[4:])] == [0, 0, 2, 3]


def test_a_run_that_ends_too_early_says_why_at_its_last_tick(record: apnc.Record) -> None:
    last = events(replace(record, end=End.fell, message="the trunk touched"))[-1]
    assert last == (len(record) - 1, Severity.error, "fell: the trunk touched")


def test_the_state_names_the_broken_sensor_and_gives_the_numbers(record: apnc.Record) -> None:
    state = {status["name"]: status for status in statuses(record, 4)}
    assert {name: status["level"] for name, status in state.items()} == {
        "controller": 0,
        "foot sensor RF": 0,
        "foot sensor RH": 0,
        "foot sensor LF": 2,
        "foot sensor LH": 0,
    }
    numbers = {pair["key"]: float(pair["value"]) for pair in state["foot sensor RH"]["values"]}
    assert numbers["grf"] == pytest.approx(record.signals["grf"][4, 1], rel=1e-5)
    assert "couplings are on" in state["controller"]["message"]
    assert "couplings are off" in statuses(record, 2)[0]["message"]
