"""Conservation laws, friction on a slope and convergence with the step, against closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest

from apnc_plant.coordinates import BASE
from apnc_plant.ground import Ground
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from exudyn_models.plant import Plant

TICK = 1 / 60
GRAVITY = 9.81
ROBOT = load_robot("lilibot")
ZERO = np.zeros(4)


def energy(plant: Plant, robot: RobotDescription, gravity: float) -> float:
    """Kinetic, potential and spring energy of joints and feet [J]."""
    m, q, v = plant._engine.mass_matrix(), plant._q, plant._v
    kinetic = v @ m @ v / 2.0
    # A pitch rate moves the centre of mass along the heading by its height over the base.
    height = q[2] + m[0, 4] / (plant.mass * math.cos(q[3]))
    stretch = q[BASE:] - plant._forces.target
    depth = robot.contact.foot_radius - plant.sample()["foot_position"][:, 2]
    springs = robot.servo.stiffness * (stretch**2).sum()
    springs += robot.contact.stiffness * (np.maximum(0.0, depth) ** 2).sum()
    return float(kinetic + plant.mass * gravity * height + springs / 2.0)


def test_without_losses_energy_is_conserved() -> None:
    robot = replace(
        ROBOT,
        servo=replace(ROBOT.servo, damping=0.0, stall_torque=1e6, no_load_speed=1e9),
        contact=replace(ROBOT.contact, damping=0.0, friction=0.0),
    )
    largest = []
    for step in (PlantOptions().step, PlantOptions().step / 4):
        plant = Plant(robot, options=PlantOptions(step=step, clearance=0.01))
        start, drift = energy(plant, robot, GRAVITY), 0.0
        for _ in range(120):
            plant.advance(ZERO, ZERO, 0.025)
            drift = max(drift, abs(energy(plant, robot, GRAVITY) - start))
        largest.append(drift)
    # Falling by 1 cm puts 0.25 J into the springs. Explicit Euler gains 92 J in these three
    # seconds, and 8 J with half the step; what is left here comes from the Coriolis terms.
    assert largest[0] < 0.01 * 0.25
    assert largest[1] < 0.3 * largest[0]


def test_damping_and_friction_take_energy_out() -> None:
    plant = Plant(ROBOT, options=PlantOptions(clearance=0.01))
    start = energy(plant, ROBOT, GRAVITY)
    for _ in range(60):
        plant.advance(ZERO, ZERO, TICK)
    end = energy(plant, ROBOT, GRAVITY)
    # It has come down by the clearance, to rest on sagging legs: less than m g h is left of it.
    assert start - end > 0.9 * ROBOT.weight * 0.01


def momentum_error(step: float) -> float:
    """Largest difference between momentum and impulse over a second of trot [N s]."""
    plant = Plant(ROBOT, options=PlantOptions(step=step))
    impulse, worst = np.zeros(3), 0.0
    steps = round(TICK / step)
    for tick in range(60):
        side = np.array([1.0, -1.0, -1.0, 1.0])
        hip = 0.13 * math.sin(0.12 * tick) * side
        knee = 0.08 * math.cos(0.12 * tick) * side
        for _ in range(steps):
            force = plant.sample()["foot_force"].sum(axis=0)
            impulse += (force - [0.0, 0.0, plant.mass * GRAVITY]) * (TICK / steps)
            plant.advance(hip, knee, TICK / steps)
        momentum = (plant._engine.mass_matrix() @ plant._v)[:3]
        worst = max(worst, float(np.abs(momentum - impulse).max()))
    return worst


def test_momentum_changes_by_the_forces_on_the_feet_and_weight() -> None:
    # Recorded foot forces must be all there is. They are those of the speed at their time, and
    # those that act of the speed half a step before: what is left is of the order of the step.
    coarse, fine = momentum_error(TICK / 32), momentum_error(TICK / 128)
    assert coarse < 0.003 * ROBOT.weight
    assert fine < 0.3 * coarse


SLIPPERY = replace(ROBOT, contact=replace(ROBOT.contact, friction=0.3))
ANGLE = math.atan(0.3)


def slide(slope: float, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Speed along the slope at the ends of two halves of a time on it [m/s]."""
    plant = Plant(SLIPPERY, ground=Ground(slope=slope))
    speeds = []
    for _ in range(2):
        for _ in range(round(seconds / 2 / TICK)):
            plant.advance(ZERO, ZERO, TICK)
        speeds.append(plant.sample()["velocity"])
    return speeds[0], speeds[1]


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_below_the_friction_angle_the_robot_creeps_as_the_law_says(share: float) -> None:
    # Regularised friction carries m g sin(a) at v = friction_speed tan(a) / friction.
    slope = share * ANGLE
    speeds = slide(slope, 2.0)
    expected = SLIPPERY.contact.friction_speed * math.tan(slope) / 0.3
    downhill = np.array([-math.cos(slope), 0.0, -math.sin(slope)])
    for speed in speeds:
        np.testing.assert_allclose(speed, expected * downhill, atol=0.01 * expected)


def test_above_the_friction_angle_the_robot_slides_away() -> None:
    slope = 1.3 * ANGLE
    before, after = slide(slope, 2.0)
    acceleration = GRAVITY * (math.sin(slope) - 0.3 * math.cos(slope))
    downhill = np.array([-math.cos(slope), 0.0, -math.sin(slope)])
    np.testing.assert_allclose(after - before, acceleration * downhill, rtol=0.01, atol=0.005)


def test_on_a_slope_the_feet_carry_weight_and_downhill_force() -> None:
    slope = 0.15
    plant = Plant(ROBOT, ground=Ground(slope=slope))
    for _ in range(120):
        plant.advance(ZERO, ZERO, TICK)
    force = plant.sample()["foot_force"].sum(axis=0)
    np.testing.assert_allclose(force, [0.0, 0.0, ROBOT.weight], atol=1e-3 * ROBOT.weight)
    quiet = replace(ROBOT, sensor=replace(ROBOT.sensor, noise=0.0))
    plant = Plant(quiet, ground=Ground(slope=slope))
    for _ in range(120):
        plant.advance(ZERO, ZERO, TICK)
    assert plant.grf().sum() == pytest.approx(ROBOT.weight * math.cos(slope), rel=1e-3)
    assert not plant.fell


@pytest.mark.parametrize("seed", range(3))
def test_on_obstacles_the_robot_settles_without_a_jump(seed: int) -> None:
    plant = Plant(ROBOT, ground=Ground(roughness=1.0, seed=seed))
    assert plant.sample()["foot_force"].max() < 0.1
    for _ in range(180):
        plant.advance(ZERO, ZERO, TICK)
    assert plant.sample()["foot_force"][:, 2].sum() == pytest.approx(ROBOT.weight, rel=0.01)
    assert not plant.fell


def test_the_robot_falls_as_gravity_along_a_frictionless_slope() -> None:
    icy = replace(ROBOT, contact=replace(ROBOT.contact, friction=0.0))
    plant = Plant(icy, ground=Ground(slope=0.1))
    for _ in range(60):
        plant.advance(ZERO, ZERO, TICK)
    speed = np.linalg.norm(plant.sample()["velocity"])
    assert speed == pytest.approx(GRAVITY * math.sin(0.1) * 1.0, rel=0.02)


def test_recorded_work_is_that_of_every_step() -> None:
    # Torque times speed once per tick misses a tenth of it: torques peak between two ticks.
    plant = Plant(ROBOT)
    summed = 0.0
    for tick in range(120):
        side = np.array([1.0, -1.0, -1.0, 1.0])
        hip = 0.13 * math.sin(0.12 * tick) * side
        knee = 0.08 * math.cos(0.12 * tick) * side
        for _ in range(128):
            plant.advance(hip, knee, TICK / 128)
            sample = plant.sample()
            power = np.abs(sample["joint_torque"] * sample["joint_speed"]).sum()
            summed += power * TICK / 128
    assert summed > 1.0
    assert plant.sample()["joint_work"].sum() == pytest.approx(summed, rel=0.01)


def test_the_centre_of_mass_is_off_to_either_side_by_the_stated_amount() -> None:
    # Moments about the x axis: the trunk's offset is all that makes left and right differ.
    quiet = replace(ROBOT, trunk=replace(ROBOT.trunk, com_side_offset=0.004))
    offsets = []
    for seed in range(8):
        plant = Plant(quiet, seed)
        for _ in range(90):
            plant.advance(ZERO, ZERO, TICK)
        sample = plant.sample()
        force, foot = sample["foot_force"], sample["foot_position"] - sample["position"]
        ground = foot - [0.0, 0.0, ROBOT.contact.foot_radius]
        moment = (ground[:, 1] * force[:, 2] - ground[:, 2] * force[:, 1]).sum()
        offsets.append(moment / (ROBOT.trunk.body.mass * GRAVITY))
    sizes = np.abs(offsets) / 0.004
    assert 0.7 < sizes.min() < sizes.max() < 1.3
    assert 2 <= np.sum(np.array(offsets) > 0.0) <= 6
    assert np.ptp(sizes) > 0.1
