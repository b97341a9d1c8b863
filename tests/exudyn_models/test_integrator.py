"""Exudyn's Velocity Verlet, which it calls under development, against closed form and promises.

Positions and forces are at whole steps, the speeds that forces see half a step earlier:
v' = v + h/2 a(q, v'_before), q += h v', v = v' + h/2 a(q, v').
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from exudyn_feet import MarkedPlant
from plain_robot import plain_robot
from plants import trot as step_of_trot

from apnc_plant.options import PlantOptions
from apnc_plant.step import own_step
from exudyn_models.engine import exu, items
from exudyn_models.plant import ExudynPlant, _solver_settings

TICK = 1 / 60
ROBOT = plain_robot()
STEP = own_step(ROBOT)


def trot(plant: ExudynPlant, tick: int, parts: int = 1) -> None:
    """A tick of a trot on fixed phases, in so many equal parts."""
    for _ in range(parts):
        step_of_trot(plant, tick, TICK / parts)


def motion(
    acceleration: Callable[[float, float], float], step: float, steps: int, x: float, v: float
) -> tuple[float, float]:
    """Place and speed of a unit mass after so many steps of the plant's solver."""
    container = exu().SystemContainer()
    mbs = container.AddSystem()
    node = mbs.AddNode(
        items().NodeGenericODE2(
            referenceCoordinates=[0.0],
            initialCoordinates=[x],
            initialCoordinates_t=[v],
            numberOfODE2Coordinates=1,
        )
    )
    mbs.AddObject(
        items().ObjectGenericODE2(
            nodeNumbers=[node],
            massMatrix=np.eye(1),
            forceUserFunction=lambda mbs, t, item, q, v: [acceleration(q[0], v[0])],
        )
    )
    mbs.Assemble()
    settings, solver = _solver_settings(step), exu().MainSolverExplicit()
    solver.InitializeSolver(mbs, settings)
    solver.it.maxStepSize = solver.it.currentStepSize = step
    solver.it.endTime = step * steps
    solver.SolveSteps(mbs, settings)
    data = mbs.systemData
    return float(data.GetODE2Coordinates()[0]), float(data.GetODE2Coordinates_t()[0])


def order(
    acceleration: Callable[[float, float], float], start: tuple[float, float], end: float
) -> float:
    """Order of the error of the place after one second."""
    errors = [abs(motion(acceleration, 1.0 / n, n, *start)[0] - end) for n in (50, 100)]
    return math.log2(errors[0] / errors[1])


def test_forces_of_place_are_integrated_at_second_order_forces_of_speed_at_first() -> None:
    assert order(lambda x, v: -9.0 * x, (1.0, 0.0), math.cos(3.0)) == pytest.approx(2.0, abs=0.02)
    decayed = (1.0 - math.exp(-2.0)) / 2.0
    assert order(lambda x, v: -2.0 * v, (0.0, 1.0), decayed) == pytest.approx(1.0, abs=0.02)


def test_damping_takes_from_the_speed_between_two_steps_what_explicit_euler_takes() -> None:
    h, damping, n = 0.05, 3.0, 40
    between = (1.0 - 0.5 * h * damping) * (1.0 - h * damping) ** (n - 1)  # at t = (n - 1/2) h
    expected = between * (1.0 - 0.5 * h * damping)
    _, speed = motion(lambda x, v: -damping * v, h, n, 0.0, 1.0)
    assert speed == pytest.approx(expected, rel=1e-12)


def test_an_oscillator_keeps_its_energy_for_good() -> None:
    # 100 rad/s at the default step for 16 s; explicit Euler: (1 + (w h)^2)^n = e^166
    w = 100.0
    for n in (1000, 5003, 15360):
        x, v = motion(lambda x, v: -w * w * x, STEP, n, 1.0, 0.0)
        assert 0.5 * (x * x + (v / w) ** 2) == pytest.approx(0.5, rel=(w * STEP) ** 2)


def test_free_fall_is_exact_at_the_default_step() -> None:
    plant = ExudynPlant(ROBOT, options=PlantOptions(clearance=1.0))
    start = plant.sample()["position"]
    for _ in range(18):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    fallen = start - plant.sample()["position"]
    np.testing.assert_allclose(fallen, [0.0, 0.0, 9.81 * 0.3**2 / 2], atol=1e-12)
    np.testing.assert_allclose(plant.sample()["velocity"], [0.0, 0.0, -9.81 * 0.3], atol=1e-12)


def steps_asked(plant: ExudynPlant, monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Grows by the length of every step that the forces are asked for."""
    asked, evaluate = [], plant._forces._evaluate

    def counted(dt: float, out: Any) -> None:
        if dt > 0.0:
            asked.append(dt)
        evaluate(dt, out)

    monkeypatch.setattr(plant._forces, "_evaluate", counted)
    return asked


def test_forces_are_asked_once_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    plant = ExudynPlant(ROBOT)
    asked = steps_asked(plant, monkeypatch)
    trot(plant, 0)
    assert asked == [STEP] * 16
    trot(plant, 1, parts=2)
    np.testing.assert_allclose(asked, STEP, rtol=1e-12)
    assert len(asked) == 32


@pytest.mark.parametrize(
    ("ticks", "early", "late"), [(0.25, 4, 12), (1.25, 4, 12), (3.3, 5, 12), (2.0, 0, 16)]
)
def test_every_tick_is_cut_where_a_command_arrives_the_first_one_too(
    ticks: float, early: int, late: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    # before the start the servos were told the start pose once a tick
    plant = ExudynPlant(replace(ROBOT, servo=replace(ROBOT.servo, latency=ticks * TICK)))
    asked = steps_asked(plant, monkeypatch)
    part = ticks % 1.0
    for tick in range(4):
        trot(plant, tick)
        assert len(asked) == early + late
        np.testing.assert_allclose(asked[:early], part * TICK / max(1, early), rtol=1e-6)
        np.testing.assert_allclose(asked[early:], (1.0 - part) * TICK / late, rtol=1e-6)
        asked.clear()


def test_a_tick_is_the_sum_of_its_halves() -> None:
    whole, halves = ExudynPlant(ROBOT), ExudynPlant(ROBOT)
    trot(whole, 0)
    trot(halves, 0, parts=2)
    np.testing.assert_array_equal(whole._q, halves._q)
    np.testing.assert_array_equal(whole._v, halves._v)
    # later the length of a step, from the difference of two times, differs in its last bit
    for tick in range(1, 60):
        trot(whole, tick)
        trot(halves, tick, parts=2)
    np.testing.assert_allclose(whole._q, halves._q, atol=1e-13)
    np.testing.assert_allclose(whole._v, halves._v, atol=1e-12)


def test_loads_are_those_of_place_and_speed_at_the_end_of_the_tick() -> None:
    plant = MarkedPlant(ROBOT)
    contact, velocity = ROBOT.contact, exu().OutputVariableType.Velocity
    touched = 0
    for tick in range(120):
        trot(plant, tick)
        sample = plant.sample()
        for k, marker in enumerate(plant._engine.feet):
            depth = max(0.0, contact.foot_radius - sample["foot_position"][k, 2])
            rate = -plant._engine.mbs.GetMarkerOutput(marker, velocity)[2]
            onset = min(1.0, depth / contact.damping_depth)
            expected = max(0.0, contact.stiffness * depth + contact.damping * onset * rate)
            assert sample["foot_force"][k, 2] == pytest.approx(expected, abs=1e-9)
            touched += expected > 1.0
    assert touched > 100


def test_momentum_changes_by_the_forces_that_act() -> None:
    plant = ExudynPlant(ROBOT)
    size = len(plant._q)
    weight = np.array([0.0, 0.0, ROBOT.weight])
    impulse = np.zeros(3)

    def acting() -> np.ndarray:
        return plant._forces._generalized[size + 24 : size + 36].reshape(4, 3).sum(axis=0) - weight

    plant._forces.acting(plant._q, plant._v)  # as Exudyn asked at the start, with the foot's mass
    before = acting()
    for tick in range(60 * 16):
        step_of_trot(plant, tick // 16, STEP)
        impulse += 0.5 * STEP * (before + (before := acting()))
        momentum = (plant._engine.mass_matrix() @ plant._v)[:3]
        np.testing.assert_allclose(momentum, impulse, atol=1e-4)
