"""Contact of the feet, in the formula and in every plant: normal force, friction, slopes."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from plants import Kind, in_both

from apnc_plant.ground import Obstacles
from apnc_plant.library import library
from apnc_plant.numbers import contact_numbers
from apnc_plant.robot import Contact, load_robot

TICK = 1 / 60
GRAVITY = 9.81
ROBOT = load_robot("lilibot")
ZERO = np.zeros(4)
SLIPPERY = replace(ROBOT, contact=replace(ROBOT.contact, friction=0.3))
ANGLE = math.atan(0.3)


def slide(kind: Kind, slope: float, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Speed along the slope at the ends of two halves of a time on it [m/s]."""
    plant = kind(SLIPPERY, ground=Obstacles(slope=slope))
    speeds = []
    for _ in range(2):
        for _ in range(round(seconds / 2 / TICK)):
            plant.advance(ZERO, ZERO, TICK)
        speeds.append(plant.sample()["velocity"])
    return speeds[0], speeds[1]


@in_both
@pytest.mark.parametrize("share", [0.5, 0.9])
def test_below_the_friction_angle_the_robot_creeps_as_the_law_says(
    kind: Kind, share: float
) -> None:
    # Regularised friction carries m g sin(a) at v = friction_speed tan(a) / friction.
    slope = share * ANGLE
    speeds = slide(kind, slope, 2.0)
    expected = SLIPPERY.contact.friction_speed * math.tan(slope) / 0.3
    downhill = np.array([-math.cos(slope), 0.0, -math.sin(slope)])
    for speed in speeds:
        np.testing.assert_allclose(speed, expected * downhill, atol=0.01 * expected)


@in_both
def test_above_the_friction_angle_the_robot_slides_away(kind: Kind) -> None:
    slope = 1.3 * ANGLE
    before, after = slide(kind, slope, 2.0)
    acceleration = GRAVITY * (math.sin(slope) - 0.3 * math.cos(slope))
    downhill = np.array([-math.cos(slope), 0.0, -math.sin(slope)])
    np.testing.assert_allclose(after - before, acceleration * downhill, rtol=0.01, atol=0.005)


@in_both
def test_on_a_slope_the_feet_carry_weight_and_downhill_force(kind: Kind) -> None:
    slope = 0.15
    plant = kind(ROBOT, ground=Obstacles(slope=slope))
    for _ in range(120):
        plant.advance(ZERO, ZERO, TICK)
    force = plant.sample()["foot_force"].sum(axis=0)
    np.testing.assert_allclose(force, [0.0, 0.0, ROBOT.weight], atol=1e-3 * ROBOT.weight)
    quiet = replace(ROBOT, sensor=replace(ROBOT.sensor, noise=0.0))
    plant = kind(quiet, ground=Obstacles(slope=slope))
    for _ in range(120):
        plant.advance(ZERO, ZERO, TICK)
    assert plant.grf().sum() == pytest.approx(ROBOT.weight * math.cos(slope), rel=1e-3)
    assert not plant.fell


@in_both
@pytest.mark.parametrize("seed", range(3))
def test_on_obstacles_the_robot_settles_without_a_jump(kind: Kind, seed: int) -> None:
    plant = kind(ROBOT, ground=Obstacles(roughness=1.0, seed=seed))
    assert plant.sample()["foot_force"].max() < 0.1
    for _ in range(180):
        plant.advance(ZERO, ZERO, TICK)
    assert plant.sample()["foot_force"][:, 2].sum() == pytest.approx(ROBOT.weight, rel=0.01)
    assert not plant.fell


@in_both
def test_the_robot_falls_as_gravity_along_a_frictionless_slope(kind: Kind) -> None:
    icy = replace(ROBOT, contact=replace(ROBOT.contact, friction=0.0))
    plant = kind(icy, ground=Obstacles(slope=0.1))
    for _ in range(60):
        plant.advance(ZERO, ZERO, TICK)
    speed = np.linalg.norm(plant.sample()["velocity"])
    assert speed == pytest.approx(GRAVITY * math.sin(0.1) * 1.0, rel=0.02)


CONTACT = Contact(
    foot_radius=0.012,
    stiffness=20000.0,
    damping=400.0,
    damping_depth=2e-4,
    friction=0.5,
    friction_speed=0.03,
)


def contact_force(
    normal: Sequence[float], depth: float, velocity: Sequence[float], stopping: float = 0.0
) -> tuple[np.ndarray, float]:
    """Force on a foot and its normal part; stopping: step over apparent mass."""
    ffi, lib = library()
    force = np.zeros(3)
    press = lib.plant_contact_force(
        ffi.new("plant_contact *", contact_numbers(CONTACT)),
        list(normal),
        depth,
        list(velocity),
        stopping,
        ffi.from_buffer("double[]", force),
    )
    return force, press


@pytest.mark.parametrize(
    ("depth", "approach", "expected"),
    [
        (1e-3, 0.0, 20.0),
        (1e-3, 0.1, 60.0),
        (1e-4, 0.1, 2.0 + 0.5 * 40.0),
        (1e-9, 1.0, 0.0),
        (1e-3, -0.04, 4.0),
        (1e-3, -0.06, 0.0),
    ],
)
def test_normal_force(depth: float, approach: float, expected: float) -> None:
    force, press = contact_force((0.0, 0.0, 1.0), depth, (0.0, 0.0, -approach))
    assert press == pytest.approx(expected, abs=3e-3)
    np.testing.assert_allclose(force, [0.0, 0.0, press], atol=1e-12)


@pytest.mark.parametrize(("speed", "share"), [(0.0, 0.0), (0.015, 0.5), (0.03, 1.0), (3.0, 1.0)])
def test_friction_is_regularised_coulomb_against_the_motion(speed: float, share: float) -> None:
    velocity = (0.6 * speed, -0.8 * speed, 0.0)
    force, press = contact_force((0.0, 0.0, 1.0), 1e-3, velocity)
    np.testing.assert_allclose(force[:2], 0.5 * press * share * np.array([-0.6, 0.8]), atol=1e-12)


@pytest.mark.parametrize(("depth", "speed"), [(1e-3, 0.03), (3e-3, 0.03), (3e-3, 0.06)])
def test_friction_does_not_turn_a_foot_round_within_a_step(depth: float, speed: float) -> None:
    step, mass = 1e-3, 0.5
    force, press = contact_force((0.0, 0.0, 1.0), depth, (speed, 0.0, 0.0), step / mass)
    sticking = 0.5 * press * step / mass  # the speed that friction takes away in a step
    assert force[0] == pytest.approx(-mass / step * min(sticking, speed), rel=1e-12)
