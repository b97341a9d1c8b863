"""The reduced plant: it stands, lifts feet and forms the trot."""

from __future__ import annotations

import numpy as np
import pytest

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc_plant.robot import load_robot
from research.modes.stance import stance_of
from research.modes.trunk import SpringTrunk


def test_the_reduced_plant_stands_still_on_its_feet() -> None:
    robot = load_robot("lilibot")
    plant, stood = SpringTrunk(robot), stance_of(robot)
    still = np.zeros(4)
    for _ in range(60):
        plant.advance(still, still, 1 / 60)
    assert plant.load.sum() == pytest.approx(robot.weight, rel=1e-9)
    np.testing.assert_allclose(plant.load[:2] + plant.load[2:], 2 * stood.carried(range(4))[:2],
                               rtol=1e-6)  # fmt: skip


def test_loads_and_motion_of_the_reduced_plant_fit_at_the_end_of_a_step() -> None:
    """Implicit Euler: springs and dampers push by the heights and rates that the step leads to."""
    plant, hip, knee = SpringTrunk(load_robot("lilibot"), substeps=1), np.zeros(4), np.full(4, 0.02)
    feet, dt = plant._stance, 1 / 240
    for _ in range(5):
        before = plant._v
        plant.advance(hip, knee, dt)
        height, rise = feet.rigid @ plant._q, feet.rigid @ plant._v
        expected = feet.stiffness * (plant._wanted(hip, knee) - height - feet.lag * rise)
        np.testing.assert_allclose(plant.load, expected, rtol=1e-9)
        gained = plant._inertia @ (plant._v - before) / dt
        pushed = feet.rigid.T @ plant.load - np.array([feet.weight, 0.0, 0.0])
        np.testing.assert_allclose(gained, pushed, atol=1e-9)
        assert (plant.load > 0.0).all() and np.abs(rise).max() > 1e-3


def test_the_reduced_plant_lifts_a_foot_whose_leg_is_drawn_in() -> None:
    plant, hip = SpringTrunk(load_robot("hexapod")), np.zeros(6)
    for _ in range(120):
        plant.advance(hip, np.array([0.3, 0, 0, 0, 0, 0]), 1 / 60)
    assert plant.load[0] == 0.0
    assert plant.load.sum() == pytest.approx(plant.mass * 9.81, rel=1e-6)


def test_the_reduced_plant_forms_the_trot() -> None:
    robot = load_robot("lilibot")
    run = Experiment(robot=robot, mi=0.15, duration=12.0, controller="apc")
    c = simulate(run, plant=SpringTrunk(robot)).signals
    error = metrics.phase_error(c["o1"], c["o2"], metrics.GAITS[4]["trot"])
    assert error[0] > 2.5  # in phase, but for the first loads
    assert error[-120:].max() < metrics.STRICT_TOLERANCE
