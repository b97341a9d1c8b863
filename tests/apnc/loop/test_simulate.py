"""The closed loop, with a plant that only notes what is done to it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from apnc import Conditions, End, Experiment, Obstacles, Plane, simulate
from apnc_plant.plant import PlantError
from apnc_plant.trace import Trace

LEGS = ("RF", "RH", "LF", "LH")


class Noting:
    """A plant whose foot k carries 10 k + tick N; falls or breaks down in a chosen tick."""

    legs = LEGS
    mass = 2.5

    def __init__(self, fall_at: int = -1, break_at: int = -1) -> None:
        self.tick, self.fall_at, self.break_at = 0, fall_at, break_at
        self.durations: list[float] = []
        self.commands: list[Any] = []
        self.conditions: list[tuple[int, Conditions]] = []

    @property
    def fell(self) -> bool:
        return self.tick - 1 == self.fall_at

    def grf(self) -> Any:
        return 10.0 * np.arange(4) + self.tick

    def set_conditions(self, conditions: Conditions) -> None:
        self.conditions.append((self.tick, conditions))

    def advance(self, theta_hip: Any, theta_knee: Any, duration: float) -> None:
        if self.tick == self.break_at:
            raise PlantError("it broke")
        self.commands.append((theta_hip.copy(), theta_knee.copy()))
        self.durations.append(duration)
        self.tick += 1

    def trace(self) -> Trace:
        parts = [np.zeros(1)]
        return Trace(parts, lambda rows: {"grf": rows})


def test_loads_go_in_and_commands_out_at_every_tick_of_the_update_rate() -> None:
    plant, seen = Noting(), []
    experiment = Experiment(duration=0.5, rate=50)
    record = simulate(experiment, plant=plant, progress=lambda t, c: seen.append(t))
    assert len(record) == plant.tick == 25
    assert plant.durations == [0.02] * 25
    assert seen == pytest.approx(0.02 * np.arange(1, 26))
    assert record.time == pytest.approx(0.02 * np.arange(25))
    loads = 10.0 * np.arange(4) + np.arange(25)[:, np.newaxis]
    assert np.array_equal(record.signals["grf"], loads)
    for place, name in enumerate(("theta_hip", "theta_knee")):
        assert np.array_equal(record.signals[name], [c[place] for c in plant.commands])
    assert (record.end, record.message, record.ended_at) == (End.complete, "", 0.5)
    assert (record.legs, record.mass, record.complete) == (LEGS, 2.5, True)


def test_commands_and_conditions_change_at_their_times() -> None:
    plant = Noting()
    experiment = Experiment(
        duration=1,
        rate=50,
        mi=((0, 0.1), (0.1, 0.3)),
        turn=((0, 0.0), (0.2, -0.5)),
        reset=((0, True), (0.3, False)),
        conditions=((0, "C1"), (0.4, "C3"), (0.6, "C1")),
    )
    record = simulate(experiment, plant=plant)
    ticks = np.arange(50)
    assert np.array_equal(record.signals["MI"], np.where(ticks < 5, 0.1, 0.3))
    assert np.array_equal(record.signals["turn"], np.where(ticks < 10, 0.0, -0.5))
    assert np.array_equal(record.signals["reset"], ticks < 15)
    assert plant.conditions == [(20, Conditions(damaged=("RF",))), (30, Conditions())]


def test_a_fall_ends_the_run_with_the_tick_after_which_the_plant_fell() -> None:
    record = simulate(Experiment(duration=1), plant=Noting(fall_at=7))
    assert (record.end, len(record), record.complete) == (End.fell, 8, False)
    assert record.ended_at == pytest.approx(8 / 60)


def test_a_motion_that_breaks_down_keeps_what_was_recorded() -> None:
    record = simulate(Experiment(duration=1), plant=Noting(break_at=7))
    assert (record.end, len(record), record.message) == (End.diverged, 8, "it broke")


def test_stop_ends_the_run_before_the_next_tick() -> None:
    plant = Noting()
    record = simulate(Experiment(duration=1), plant=plant, stop=lambda: plant.tick == 7)
    assert (record.end, len(record)) == (End.interrupted, 7)


def test_a_run_of_no_tick_has_signals_without_samples() -> None:
    record = simulate(Experiment(duration=1), plant=Noting(), stop=lambda: True)
    assert (record.end, len(record), record.ended_at) == (End.interrupted, 0, 0.0)
    assert record.signals["o1"].shape == (0, 4)
    assert record.signals["phi"].shape == (0, 3)
    assert record.signals["grf"].shape == (0, 4)


def test_a_run_of_years_begins_at_once() -> None:
    plant = Noting()
    record = simulate(Experiment(duration=1e9), plant=plant, stop=lambda: plant.tick == 9)
    assert len(record) == 9


def test_an_fmu_for_other_legs_is_refused(fmu6: Path) -> None:
    with pytest.raises(ValueError, match="is for 6 legs; robot 'lilibot' has 4"):
        simulate(Experiment(fmu=str(fmu6)), plant=Noting())


def test_the_parameters_reach_the_controller() -> None:
    def hips(**settings: Any) -> Any:
        experiment = Experiment(duration=0.5, settings=settings)
        return simulate(experiment, plant=Noting()).signals["theta_hip"]

    assert not np.array_equal(hips(), hips(w12_0=0.3))


def test_seed_and_ground_reach_the_plant() -> None:
    walks = [
        simulate(Experiment(duration=1.0, seed=seed, ground=ground))
        for seed, ground in ((0, Plane()), (1, Plane()), (0, Obstacles(roughness=1.0)))
    ]
    places = [walk.signals["foot_position"] for walk in walks]
    assert not np.array_equal(places[0], places[1])
    assert not np.array_equal(places[0], places[2])


class Clock:
    """A clock that is a second further each time it is read."""

    def __init__(self) -> None:
        self.now = 0.0

    def perf_counter(self) -> float:
        self.now += 1.0
        return self.now


def test_time_of_the_controller_is_that_of_its_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr("apnc.loop.simulate.time", clock)
    monkeypatch.setattr("apnc.loop.fmu_controller.time", clock)
    record = simulate(Experiment(duration=0.5), plant=Noting())
    assert len(record) == 30
    assert record.fmu_wall_s == 30.0  # read at the start and the end of each step
    assert record.wall_s == 61.0  # and at the start and the end of the walk


def test_time_of_the_controller_is_measured_in_c() -> None:
    assert simulate(Experiment(duration=1.0, engine="compiled")).fmu_wall_s > 0.0
