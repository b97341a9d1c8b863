"""The closed loop with a made-up plant: what goes in, what comes out, and how it ends."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

import apnc
from apnc import End, Experiment, Ground
from apnc.loop.plant import PlantError
from exudyn_models.channels import PLANT_CHANNELS
from exudyn_models.conditions import Conditions
from exudyn_models.trace import Trace


@dataclass
class Stub:
    """A plant that does not move and remembers what it was told."""

    legs: tuple[str, ...] = ("RF", "RH", "LF", "LH")
    mass: float = 2.5
    fall_at: int | None = None
    break_at: int | None = None
    conditions: list[tuple[int, Conditions]] = field(default_factory=list)
    commands: list[tuple[float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.state = np.zeros(1)

    @property
    def fell(self) -> bool:
        return len(self.commands) == self.fall_at

    def grf(self) -> np.ndarray:
        return np.arange(4.0) + len(self.commands)

    def set_conditions(self, conditions: Conditions) -> None:
        self.conditions.append((len(self.commands), conditions))

    def advance(self, theta_hip: np.ndarray, theta_knee: np.ndarray, duration: float) -> None:
        self.commands.append((float(theta_hip[0]), duration))
        if len(self.commands) == self.break_at:
            raise PlantError("it broke")

    def trace(self) -> Trace:
        def split(rows: np.ndarray) -> dict[str, np.ndarray]:
            return {c.name: np.zeros((len(rows), *c.shape(4))) for c in PLANT_CHANNELS}

        return Trace([self.state], split)


def test_loads_go_to_the_controller_and_commands_to_the_plant_in_the_same_tick() -> None:
    plant = Stub()
    record = apnc.simulate(Experiment(duration=0.5, rate=20.0), plant=plant)
    assert record.end is End.complete and len(record) == 10 and record.ended_at == 0.5
    np.testing.assert_array_equal(record.controller["grf"][:, 0], np.arange(10.0))
    np.testing.assert_allclose(record.controller["theta_hip"][:, 0], [c[0] for c in plant.commands])
    assert {c[1] for c in plant.commands} == {0.05}
    np.testing.assert_allclose(record.time, np.arange(10) / 20.0)


def test_commands_and_conditions_change_when_they_should() -> None:
    plant = Stub()
    experiment = Experiment(
        duration=1.0,
        rate=10.0,
        mi=((0.0, 0.1), (0.5, 0.2)),
        turn=((0.0, 0.0), (0.3, -1.0)),
        reset=((0.0, False), (0.8, True)),
        conditions=((0.0, "C1"), (0.4, "C2"), (0.6, "C1")),
    )
    record = apnc.simulate(experiment, plant=plant)
    np.testing.assert_allclose(record.controller["MI"], [0.1] * 5 + [0.2] * 5)
    np.testing.assert_allclose(record.controller["turn"], [0.0] * 3 + [-1.0] * 7)
    np.testing.assert_allclose(record.controller["reset"], [0.0] * 8 + [1.0] * 2)
    assert [(n, c.grf_noise) for n, c in plant.conditions] == [(4, 0.2), (6, 0.0)]


def test_a_fall_ends_the_run_and_says_so() -> None:
    record = apnc.simulate(Experiment(duration=1.0), plant=Stub(fall_at=7))
    assert record.end is End.fell and len(record) == 7 and not record.complete


def test_what_breaks_down_keeps_what_was_recorded() -> None:
    record = apnc.simulate(Experiment(duration=1.0), plant=Stub(break_at=7))
    assert record.end is End.diverged and record.message == "it broke" and len(record) == 7


@pytest.mark.parametrize("ticks", [0, 3])
def test_a_stop_keeps_what_was_recorded(ticks: int) -> None:
    plant = Stub()
    record = apnc.simulate(
        Experiment(duration=1.0), plant=plant, stop=lambda: len(plant.commands) == ticks
    )
    assert record.end is End.interrupted and len(record) == ticks
    assert record.controller["o1"].shape == (ticks, 4)
    assert record.plant["foot_force"].shape == (ticks, 4, 3)


def test_an_fmu_for_other_legs_is_refused(fmu6: object) -> None:
    with pytest.raises(ValueError, match="is for 6 legs; robot 'lilibot' has 4"):
        apnc.simulate(Experiment(duration=1.0, fmu=str(fmu6)), plant=Stub())


def test_seed_and_ground_reach_the_plant() -> None:
    walks = [
        apnc.simulate(Experiment(duration=1.0, seed=seed, ground=ground))
        for seed, ground in ((0, Ground()), (1, Ground()), (0, Ground(roughness=1.0)))
    ]
    places = [walk.plant["foot_position"] for walk in walks]
    assert not np.array_equal(places[0], places[1])
    assert not np.array_equal(places[0], places[2])
