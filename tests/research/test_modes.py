"""Modes of compliant legs in closed form, the reduced plant, and the phase return map."""

from __future__ import annotations

import numpy as np
import pytest

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc.studies.robots import symmetric
from apnc_core import oscillator
from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_plant.robot import load_robot
from research.modes.gaits import CANDIDATES, gait_of, mirrored
from research.modes.returns import (
    ReturnMap,
    free_cycle,
    parameters_of,
    release,
    return_map,
)
from research.modes.stance import Stance, patterns, stance_of
from research.modes.trunk import SpringTrunk

K = 3000.0
WEIGHT = 36.0


def stance(widths: tuple[float, ...], k: tuple[float, ...] | None = None) -> Stance:
    """Pairs of legs 0.1 m apart, each pair as far from the middle as its width [m]."""
    along = 0.1 * (np.arange(len(widths))[::-1] - (len(widths) - 1) / 2)
    x, y = np.tile(along, 2), np.concatenate([-np.array(widths), widths])
    stiffness = np.tile(k if k else (K,) * len(widths), 2)
    return Stance(x, y, stiffness, lag=0.05, weight=WEIGHT)


@pytest.mark.parametrize("n_legs", [4, 6, 8])
def test_patterns_are_orthonormal(n_legs: int) -> None:
    basis = np.array(list(patterns(n_legs).values()))
    np.testing.assert_allclose(basis @ basis.T, np.eye(n_legs), atol=1e-12)


def test_the_trunk_follows_heave_pitch_and_roll_and_nothing_else() -> None:
    found = stance((0.07, 0.07, 0.07, 0.07)).loads()
    np.testing.assert_allclose(np.linalg.eigvalsh(found), [0, 0, 0, K, K, K, K, K], atol=1e-9)
    for name in ("heave", "pitch", "roll"):
        np.testing.assert_allclose(found @ patterns(8)[name], 0.0, atol=1e-9)


def test_of_four_legs_the_trunk_cannot_follow_the_warp_alone() -> None:
    warp = patterns(4)["warp"]
    np.testing.assert_allclose(warp, [0.5, -0.5, -0.5, 0.5])
    np.testing.assert_allclose(stance((0.07, 0.07)).loads(), K * np.outer(warp, warp), atol=1e-9)


@pytest.mark.parametrize("ratio", [1.0, 2.0, 3.0])
def test_a_tripod_is_a_pure_load_pattern_if_the_middle_stands_twice_as_wide(ratio: float) -> None:
    tripod = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    loaded = stance((0.05, 0.05 * ratio, 0.05)).loads() @ tripod
    # the part of the pattern that is roll, (2 - r)^2 / (2 + r^2) of 6, the trunk follows
    followed = (2.0 - ratio) ** 2 / (2.0 + ratio**2) / 3.0
    np.testing.assert_allclose(tripod @ loaded / 6.0, K * (1.0 - followed), rtol=1e-12)
    if ratio == 2.0:
        np.testing.assert_allclose(loaded, K * tripod, rtol=1e-12)


def test_bend_of_legs_of_unequal_stiffness() -> None:
    bend = np.array([1.0, -2.0, 1.0, 1.0, -2.0, 1.0])
    found = stance((0.06, 0.06, 0.06), (K, 3 * K, K)).loads() @ bend
    # in series: 1, -2, 1 loads three springs per side, f = 6 / (1/k + 4/(3k) + 1/k) (1, -2, 1)
    np.testing.assert_allclose(found, 6.0 / (2.0 / K + 4.0 / (3.0 * K)) * bend, rtol=1e-12)


def test_a_tripod_carries_a_third_each_if_the_middle_stands_twice_as_wide() -> None:
    np.testing.assert_allclose(
        stance((0.05, 0.10, 0.05)).carried([0, 2, 4]), [12, 0, 12, 0, 12, 0], atol=1e-9
    )
    np.testing.assert_allclose(
        stance((0.05, 0.05, 0.05)).carried([0, 2, 4]), [9, 0, 9, 0, 18, 0], atol=1e-9
    )


def test_legs_that_cannot_carry_are_refused() -> None:
    with pytest.raises(ValueError, match="2 legs do not carry a trunk"):
        stance((0.05, 0.05)).carried([0, 3])
    with pytest.raises(ValueError, match="not over these feet"):
        stance((0.05, 0.05, 0.05)).carried([0, 1, 3])


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


def test_the_free_cycle_repeats_itself() -> None:
    cycle = free_cycle(Parameters(), 0.15)
    assert 60.0 / cycle.ticks == pytest.approx(2.0, abs=0.05)  # formation/departures.md: 2.00 Hz
    phase = np.linspace(0.0, 2 * np.pi, 7)
    a1, a2 = oscillator.activation(*cycle.at(phase), 0.15, Parameters())
    later = cycle.at(phase + 2 * np.pi / cycle.ticks)
    np.testing.assert_allclose(np.tanh([a1, a2]), later, atol=0.01)


def test_the_reduced_plant_forms_the_trot() -> None:
    robot = load_robot("lilibot")
    run = Experiment(robot=robot, mi=0.15, duration=12.0, controller="apc")
    c = simulate(run, plant=SpringTrunk(robot)).signals
    error = metrics.phase_error(c["o1"], c["o2"], metrics.GAITS[4]["trot"])
    assert error[0] > 2.5  # in phase, but for the first loads
    assert error[-120:].max() < metrics.STRICT_TOLERANCE


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


@pytest.mark.parametrize(("n", "name"), [(n, name) for n in (4, 6, 8) for name in CANDIDATES[n]])
def test_a_gait_and_its_mirror_image_have_one_name(n: int, name: str) -> None:
    gait = np.array(CANDIDATES[n][name]) + 0.2
    assert gait_of(gait) == gait_of(mirrored(gait)) == name
    np.testing.assert_allclose(metrics.wrap(mirrored(mirrored(gait)) - gait), 0.0, atol=1e-12)


def test_a_gait_without_a_name() -> None:
    assert gait_of([0.5 * np.pi, 0.0, 0.5 * np.pi]) == "other"
