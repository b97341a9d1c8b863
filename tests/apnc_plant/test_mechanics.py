"""Friction on slopes and obstacles, work and the offset of the centre of mass, in every plant."""

import math
from dataclasses import replace

import numpy as np
import pytest
from plants import Kind, in_both

from apnc_plant.ground import Obstacles
from apnc_plant.robot import load_robot

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


@in_both
def test_recorded_work_is_that_of_every_step(kind: Kind) -> None:
    # Torque times speed once per tick misses a tenth of it: torques peak between two ticks.
    plant = kind(ROBOT)
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


@in_both
def test_the_centre_of_mass_is_off_to_either_side_by_the_stated_amount(kind: Kind) -> None:
    # Moments about the x axis: the trunk's offset is all that makes left and right differ.
    quiet = replace(ROBOT, trunk=replace(ROBOT.trunk, com_side_offset=0.004))
    offsets = []
    for seed in range(8):
        plant = kind(quiet, seed)
        for _ in range(90):
            plant.advance(ZERO, ZERO, TICK)
        sample = plant.sample()
        force, foot = sample["foot_force"], sample["foot_position"] - sample["position"]
        ground = foot - [0.0, 0.0, ROBOT.contact.foot_radius]
        moment = (ground[:, 1] * force[:, 2] - ground[:, 2] * force[:, 1]).sum()
        offsets.append(moment / (ROBOT.trunk.mass * GRAVITY))
    sizes = np.abs(offsets) / 0.004
    assert 0.7 < sizes.min() < sizes.max() < 1.3
    assert 2 <= np.sum(np.array(offsets) > 0.0) <= 6
    assert np.ptp(sizes) > 0.1
