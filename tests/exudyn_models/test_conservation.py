"""Conservation laws, with the mass matrix of the engine."""

import math
from dataclasses import replace

import numpy as np

from apnc_plant.coordinates import BASE
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.step import own_step
from exudyn_models.plant import ExudynPlant

TICK = 1 / 60
GRAVITY = 9.81
ROBOT = load_robot("lilibot")
ZERO = np.zeros(4)


def energy(plant: ExudynPlant, robot: RobotDescription, gravity: float) -> float:
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
    for step in (own_step(ROBOT), own_step(ROBOT) / 4):
        plant = ExudynPlant(robot, options=PlantOptions(step=step, clearance=0.01))
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
    plant = ExudynPlant(ROBOT, options=PlantOptions(clearance=0.01))
    start = energy(plant, ROBOT, GRAVITY)
    for _ in range(60):
        plant.advance(ZERO, ZERO, TICK)
    end = energy(plant, ROBOT, GRAVITY)
    # It has come down by the clearance, to rest on sagging legs: less than m g h is left of it.
    assert start - end > 0.9 * ROBOT.weight * 0.01


def momentum_error(step: float) -> float:
    """Largest difference between momentum and impulse over a second of trot [N s]."""
    plant = ExudynPlant(ROBOT, options=PlantOptions(step=step))
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
