"""The search: knobs, and costs of made-up walks with closed-form answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from records import TROT, synthetic_record

from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.loop.simulate import simulate
from apnc.studies.search.__main__ import search
from apnc.studies.search.costs import (
    BANDS,
    COSTS,
    STEERING,
    WANTED_STEERING,
    WANTED_TURN,
    _StuckSensor,
    blocked_cost,
    damage_cost,
    formation_cost,
    payload_cost,
    ratio_cost,
    steering_cost,
    walk_cost,
)
from apnc.studies.search.knobs import KNOBS, PUBLISHED, built_robot, gains

Array = NDArray[np.float64]


def test_knobs_reach_their_ends_and_their_start() -> None:
    for knob in KNOBS:
        assert knob.value(0.0) == pytest.approx(knob.low)
        assert knob.value(1.0) == pytest.approx(knob.high)
        assert knob.value(knob.place(knob.start)) == pytest.approx(knob.start)


def test_a_candidate_is_a_robot_and_gains() -> None:
    candidate = {"a1": 0.2, "trunk.com_z": 0.003, "trunk.com_x": 0.01, "servo.damping": 0.5}
    robot = built_robot(candidate)
    assert robot.trunk.body.com[0] == 0.01 and robot.trunk.body.com[2] == 0.003
    assert robot.servo.damping == 0.5
    assert gains(candidate) == {**PUBLISHED, "a1": 0.2}
    Experiment(settings=gains({knob.name: knob.start for knob in KNOBS}))  # all are parameters


def walk(phases: Sequence[float] = TROT, speed: float = 0.1) -> Record:
    return synthetic_record(15.0, phases, speed=speed)


def on_feet(record: Record, feet: Array) -> Record:
    return replace(record, plant={**record.plant, "foot_position": feet})


def test_an_exact_straight_trot_on_clean_feet_costs_nothing() -> None:
    assert formation_cost(walk()) == pytest.approx(0.0, abs=1e-6)
    assert walk_cost(walk()) == pytest.approx(0.0, abs=0.05)


def test_another_gait_costs_its_distance() -> None:
    # all of the time pi from the trot: 2 x 1, and 1.5 x the limit of 1.5
    assert formation_cost(walk((0.0, 0.0, 0.0))) == pytest.approx(2.0 + 1.5 * 1.5, abs=0.01)


def test_every_foot_that_hardly_lifts_costs() -> None:
    record = walk()
    flat = record.plant["foot_position"].copy()
    flat[:, 0, 2] = 0.0
    assert walk_cost(on_feet(record, flat)) - walk_cost(record) == pytest.approx(0.35, abs=0.01)
    flat[..., 2] = 0.0
    assert walk_cost(on_feet(record, flat)) - walk_cost(record) == pytest.approx(1.4, abs=0.01)


def test_every_foot_that_slips_costs() -> None:
    record = walk()
    feet = record.plant["foot_position"].copy()
    # in stance, 0.6 of a cycle of 1 / 1.4 s, a fifth of a stride of 0.1 / 1.4 m: twice what may be
    standing = record.plant["foot_force"][:, 3, 2] > 0.0
    feet[:, 3, 1] += np.cumsum(standing) * (0.2 * 0.1 / 1.4) / (0.6 / 1.4 * 60.0)
    found = walk_cost(on_feet(record, feet)) - walk_cost(record)
    assert found == pytest.approx(0.35 * (0.2 / 0.1 - 1.0), abs=0.08)


def test_a_slow_walk_costs() -> None:
    # at MI 0.08 0.068 m/s are asked for; a slow walk has short strides, so the rest differs
    assert walk_cost(walk(speed=0.038)) - walk_cost(walk()) == pytest.approx(0.6, abs=0.02)
    assert payload_cost(walk(speed=0.03)) - payload_cost(walk()) == pytest.approx(0.4, abs=0.02)


def test_a_curve_costs_by_its_rate_to_either_side() -> None:
    record = walk()
    for sign in (1.0, -1.0):
        rpy = record.plant["rpy"].copy()
        rpy[:, 2] = sign * 3.0 * WANTED_TURN * record.time
        turned = replace(record, plant={**record.plant, "rpy": rpy})
        added = walk_cost(turned) - walk_cost(record)
        assert added == pytest.approx(0.35 * np.log(4.0), abs=0.02)


def test_less_than_twice_the_speed_costs() -> None:
    assert ratio_cost(0.1, 0.2) == ratio_cost(0.1, 0.3) == 0.0
    assert ratio_cost(0.1, 0.15) == pytest.approx(0.5)
    assert ratio_cost(0.0, 0.0) == 2.0


def test_a_cost_per_band_and_name() -> None:
    assert len(COSTS) == len(BANDS) + 7 == len(set(COSTS))


def test_stopped_oscillators_cost_half_each() -> None:
    record = walk()
    o1 = record.controller["o1"].copy()
    o1[:, :2] = 0.3
    stopped = replace(record, controller={**record.controller, "o1": o1})
    assert damage_cost(stopped) - damage_cost(record) == pytest.approx(1.0)


def test_turning_goes_left_and_then_right() -> None:
    assert Experiment(**STEERING).turn == ((0.0, 0.0), (3.0, 0.5), (7.5, -0.5))


@pytest.mark.parametrize(
    ("left", "right", "cost"),
    [(1.0, 1.0, 0.0), (1.2, 1.2, 0.0), (0.5, 0.5, 1.0), (1.0, 0.5, 1.0), (0.0, 0.0, 2.0)],
)
def test_slow_and_unlike_turns_cost(
    left: float, right: float, cost: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In shares of what is asked for: what is missing on each side, and the difference."""
    record = synthetic_record(12.0)
    rate = np.where(record.time < 7.5, left, -right) * WANTED_STEERING
    rpy = record.plant["rpy"].copy()
    rpy[:, 2] = np.cumsum(rate) / 60.0
    turned = replace(record, plant={**record.plant, "rpy": rpy})
    monkeypatch.setattr("apnc.studies.search.costs.simulate", lambda experiment: turned)
    assert steering_cost(Experiment(**STEERING)) == pytest.approx(cost, abs=0.02)


def test_the_stuck_sensor_sticks_after_its_ticks() -> None:
    experiment = Experiment(method="apc", duration=0.2)
    plant = _StuckSensor(experiment.description, ticks=5)
    record = simulate(experiment, plant=plant)
    load = 0.9 * experiment.description.weight / 2.0
    assert record.controller["grf"][:, 0] == pytest.approx([0.0] * 6 + [load] * 6)


def test_a_stuck_load_stops_an_oscillator_that_learns_and_not_one_that_does_not() -> None:
    assert blocked_cost({}) == 0.0
    assert blocked_cost({"B_f": 0.0, "B_s": 0.0}) == pytest.approx(0.2 + 0.5 * 2.0, abs=0.2)


def test_without_cma_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "cma", None)
    with pytest.raises(RuntimeError, match=r"apnc\[search\]"):
        search(tmp_path)


def test_workers_make_the_same_search(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("cma", reason="the extra search is not installed")
    n = len(COSTS)

    def made_up(candidate: dict[str, float], seed: int) -> tuple[float, ...]:
        return (abs(sum(candidate.values())) + seed,) * n

    monkeypatch.setattr("apnc.studies.search.__main__._costs", made_up)
    for workers in (1, 2):
        search(tmp_path / str(workers), generations=2, workers=workers)
    one, two = ((tmp_path / name / "search.csv").read_text() for name in "12")
    assert one == two and one.count("\n") == 1 + 2 * 15
