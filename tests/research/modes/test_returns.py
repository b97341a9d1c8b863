"""The free cycle, and the phase return map of loops whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.studies.robots import symmetric
from apnc_core import oscillator
from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_plant.robot import load_robot
from research.modes.gaits import CANDIDATES
from research.modes.returns import (
    ReturnMap,
    free_cycle,
    parameters_of,
    release,
    return_map,
)
from research.modes.stance import patterns
from research.modes.trunk import SpringTrunk


def test_the_free_cycle_repeats_itself() -> None:
    cycle = free_cycle(Parameters(), 0.15)
    assert 60.0 / cycle.ticks == pytest.approx(2.0, abs=0.05)  # formation/departures.md: 2.00 Hz
    phase = np.linspace(0.0, 2 * np.pi, 7)
    a1, a2 = oscillator.activation(*cycle.at(phase), 0.15, Parameters())
    later = cycle.at(phase + 2 * np.pi / cycle.ticks)
    np.testing.assert_allclose(np.tanh([a1, a2]), later, atol=0.01)


class Weightless:
    """A plant whose feet never feel anything: every oscillator is alone."""

    fell = False

    def grf(self) -> np.ndarray:
        return np.zeros(6)

    def advance(self, theta_hip: np.ndarray, theta_knee: np.ndarray, duration: float) -> None:
        pass


def test_oscillators_that_feel_nothing_keep_every_difference() -> None:
    p = parameters_of(Experiment(robot="hexapod", mi=0.15))
    found = return_map(release(Weightless, p, 0.15), metrics.GAITS[6]["tripod"])  # type: ignore[arg-type]
    assert tuple(found.patterns) == ("roll", "pitch", "twist", "bend", "tripod")
    np.testing.assert_allclose(found.matrix, np.eye(5), atol=0.01)
    np.testing.assert_allclose(found.drift, 0.0, atol=0.01)


MAP = np.array([[0.6, 0.3, 0.0], [-0.3, 0.6, 0.1], [0.0, 0.0, 0.5]])
"""Of roll, pitch and warp; eigenvalues 0.6 + 0.3 i and its conjugate, 0.5."""


def mapped(matrix: np.ndarray, orbit: np.ndarray) -> ReturnMap:
    """The return map of phases that go by a map from one cycle of 40 ticks to the next."""
    basis = np.array(list(patterns(4).values())[1:])
    trot = np.concatenate([[0.0], metrics.GAITS[4]["trot"]])
    values, vectors = np.linalg.eig(matrix)

    def released(phases: np.ndarray) -> np.ndarray:
        cycles = np.arange(40 * 12) / 40.0
        own = np.linalg.solve(vectors, basis @ (phases - trot) - orbit)
        delta = ((values ** cycles[:, None] * own) @ vectors.T).real + orbit
        legs = delta @ basis
        return trot + 2.0 * np.pi * cycles[:, None] + legs - legs[:, :1]

    return return_map(released, metrics.GAITS[4]["trot"])


def test_a_return_map_that_is_known_is_found() -> None:
    orbit = np.array([0.1, -0.05, 0.2])
    found = mapped(MAP, orbit)
    assert tuple(found.patterns) == ("roll", "pitch", "warp")
    np.testing.assert_allclose(found.matrix, MAP, atol=0.01)
    np.testing.assert_allclose(found.drift, (np.eye(3) - MAP) @ orbit, atol=0.01)
    np.testing.assert_allclose(found.multipliers, [np.sqrt(0.45), np.sqrt(0.45), 0.5], atol=0.01)
    legs = orbit @ np.array(list(found.patterns.values()))
    assert found.orbit == pytest.approx(np.abs(legs - legs[0]).max(), abs=0.01)
    assert found.holds


def test_a_gait_that_grows_or_lies_elsewhere_does_not_hold() -> None:
    grows = mapped(np.diag([0.5, 0.5, 1.5]), np.zeros(3))
    np.testing.assert_allclose(grows.multipliers, [1.5, 0.5, 0.5], atol=0.01)
    assert not grows.holds
    elsewhere = mapped(MAP, np.array([0.0, 0.0, 0.7]))
    assert elsewhere.multipliers[0] < 0.7 and elsewhere.orbit > metrics.STRICT_TOLERANCE
    assert not elsewhere.holds


def test_of_a_gait_that_is_gone_within_a_cycle_nothing_is_said() -> None:
    found = mapped(np.diag([0.5, 0.5, 0.01]), np.array([0.0, 0.0, 5.0]))
    assert np.isnan(found.multipliers).all() and np.isnan(found.orbit) and not found.holds


def test_parameters_are_those_of_the_robot() -> None:
    p = parameters_of(Experiment(robot="hexapod"))
    hexapod = load_robot("hexapod")
    assert p.method == Method.apc and p.robot_weight == pytest.approx(hexapod.weight)
    assert {name: getattr(p, name) for name in hexapod.controller} == dict(hexapod.controller)


def reduced(robot: str, gait: str, push: float) -> ReturnMap:
    even = symmetric(load_robot(robot))
    loop = release(lambda: SpringTrunk(even), parameters_of(Experiment(robot=even)), 0.15)
    return return_map(loop, CANDIDATES[len(even.legs)][gait], push=push)


def test_in_the_reduced_plant_the_trot_holds() -> None:
    found = reduced("lilibot", "trot", 0.3)
    assert found.holds and found.multipliers[0] < 0.9


@pytest.mark.parametrize("robot", ["lilibot", "hexapod"])
def test_in_the_reduced_plant_legs_in_phase_come_apart(robot: str) -> None:
    found = reduced(robot, "pronk", 0.04).multipliers[0]
    assert np.isnan(found) or found > 1.5  # nan: gone within a cycle
