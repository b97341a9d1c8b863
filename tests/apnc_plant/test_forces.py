"""The forces for other engines against closed form: leverage of the feet, power, grounds."""

import math
from dataclasses import replace

import numpy as np
import pytest
from grounds import TOUCHED
from plain_robot import plain_robot

from apnc_plant.coordinates import BASE
from apnc_plant.forces import RobotForces
from apnc_plant.ground import Ground, Obstacles, Plane
from apnc_plant.ground.obstacles import TILE
from exudyn_models.plant import ExudynPlant

ROBOT = plain_robot()
UP = (0.0, 0.0, 1.0)


def test_the_apparent_mass_of_a_foot_on_a_heavy_trunk_is_its_rotors_over_their_levers() -> None:
    light = replace(ROBOT.legs[0].tibia, mass=1e-9, size=(1e-3, 1e-3, 1e-3))
    legs = tuple(replace(leg, hip=light, femur=light, tibia=light) for leg in ROBOT.legs)
    trunk = replace(ROBOT.trunk, mass=1e9, size=(9.0, 9.0, 9.0))
    smooth = replace(ROBOT.contact, friction=0.0)  # so great a weight needs no short steps then
    robot = replace(ROBOT, legs=legs, trunk=trunk, contact=smooth)
    leg, ground = robot.legs[0], Plane(slope=0.3)
    knee = leg.tibia_length * math.cos(leg.tibia_angle - leg.femur_angle)
    hip = knee + leg.femur_length * math.cos(leg.femur_angle)
    abduction = hip - leg.hip_offset[2]
    most = max(abduction**2, hip**2 + knee**2)
    found = ExudynPlant(robot, ground=ground)._forces.foot_mass
    assert found == pytest.approx(robot.servo.reflected_inertia / most, rel=1e-4)


def bent(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates and speeds of a robot in some twisted motion, its feet in the ground."""
    random = np.random.default_rng(seed)
    q = np.concatenate([random.uniform(-1, 1, 2), [0.1], random.uniform(-0.5, 0.5, 3)])
    return np.concatenate([q, random.uniform(-0.4, 0.4, 12)]), random.uniform(-0.3, 0.3, 18)


def at(forces: RobotForces, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
    forces.target[:] = q[BASE:]
    forces.measure(q, v)
    generalized = forces._measured[: len(q)].copy()
    generalized[BASE:] -= forces.torque
    return generalized, forces.foot.reshape(-1, 3).copy(), forces.force.reshape(-1, 3).copy()


def test_a_force_on_a_foot_moves_the_robot_as_the_foot_moves() -> None:
    # Virtual work: for a frictionless ball the force acts through its centre, so Q = J^T f with
    # the Jacobian of the centre, here by central differences.
    smooth = replace(ROBOT, contact=replace(ROBOT.contact, friction=0.0, damping=0.0))
    forces = RobotForces(smooth, Plane(slope=0.2), np.zeros(12))
    for seed in range(5):
        q, v = bent(seed)
        q[2] += q[0] * math.tan(0.2)
        generalized, _, force = at(forces, q, v)
        assert np.abs(force).max() > 1.0
        expected = np.zeros(18)
        for i in range(18):
            step = np.zeros(18)
            step[i] = 1e-6
            moved = (at(forces, q + step, v)[1] - at(forces, q - step, v)[1]) / 2e-6
            expected[i] = (moved * force).sum()
        np.testing.assert_allclose(generalized, expected, rtol=1e-6, atol=1e-6)


def test_friction_and_damping_take_power_out_of_the_robot() -> None:
    # P = Q . v must be what the contact law loses at the speed of the contact point; with a rigid
    # twist of the whole robot that speed is known without any leg kinematics.
    forces = RobotForces(ROBOT, Plane(), np.zeros(12))
    q, _ = bent(1)
    q[3:BASE] = 0.0
    q[2] = 0.12
    spin, drift = np.array([0.3, -0.2, 0.5]), np.array([0.1, -0.05, -0.02])
    v = np.concatenate([drift, spin[::-1], np.zeros(12)])
    generalized, feet, force = at(forces, q, v)
    points = feet - [0.0, 0.0, ROBOT.contact.foot_radius]
    speeds = drift + np.cross(spin, points - q[:3])
    assert (force[:, 2] > 0.0).any()
    assert generalized @ v == pytest.approx((force * speeds).sum(), rel=1e-9)
    for f, s in zip(force, speeds, strict=True):
        slip = np.hypot(*s[:2])
        share = min(1.0, slip / ROBOT.contact.friction_speed)
        expected = -ROBOT.contact.friction * f[2] * share * s[:2] / slip
        np.testing.assert_allclose(f[:2], expected, rtol=1e-9, atol=1e-12)


def one_foot_at(forces: RobotForces, place: np.ndarray) -> np.ndarray:
    """Force on foot RF when its centre is put at a place, the robot at rest."""
    q = np.zeros(18)
    q[:3] = place - at(forces, q, np.zeros(18))[1][0]
    return at(forces, q, np.zeros(18))[2][0]


def by_hand(obstacles: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The same from all obstacles, one by one: stiffness times overlap, away from the centre."""
    contact = ROBOT.contact
    force = np.array([0.0, 0.0, max(0.0, contact.foot_radius - place[2]) * contact.stiffness])
    away = place - obstacles[:, :3]
    away[:, :2] -= TILE * np.round(away[:, :2] / TILE)
    distance = np.linalg.norm(away, axis=1)
    overlap = np.maximum(0.0, obstacles[:, 3] + contact.foot_radius - distance)
    force += (overlap * contact.stiffness / distance) @ away
    return force


@pytest.mark.parametrize("seed", [0, 1])
def test_feet_are_pushed_away_from_the_centre_of_every_obstacle_they_touch(seed: int) -> None:
    ground = Obstacles(roughness=1.0, seed=seed, density=200.0)
    forces = RobotForces(ROBOT, ground, np.zeros(12))
    obstacles = ground.obstacles()
    random = np.random.default_rng(seed)
    touched = 0
    for _ in range(100):
        place = np.append(random.uniform(-9.0, 9.0, 2), random.uniform(0.011, 0.025))
        expected = by_hand(obstacles, place)
        np.testing.assert_allclose(one_foot_at(forces, place), expected, atol=1e-6)
        touched += np.hypot(*expected[:2]) > 0.1
    assert touched > 10


def test_obstacles_go_on_without_end() -> None:
    forces = RobotForces(ROBOT, Obstacles(roughness=1.0), np.zeros(12))
    x, y, z, radius = Obstacles(roughness=1.0).obstacles()[5]
    near = np.array([x + 0.003, y, z + radius + 0.0118])
    far = near + np.array([250 * TILE, -100 * TILE, 0.0])
    assert np.linalg.norm(one_foot_at(forces, near)) > 5e-5 * ROBOT.contact.stiffness
    np.testing.assert_allclose(one_foot_at(forces, far), one_foot_at(forces, near), rtol=1e-6)


def test_no_ground_is_missed_at_the_seam_of_cells() -> None:
    forces = RobotForces(ROBOT, Obstacles(roughness=1.0), np.zeros(12))
    of_the_plane = 0.001 * ROBOT.contact.stiffness
    for x in (-1e-20, 0.0, TILE, -TILE, np.nextafter(TILE, 0.0)):
        assert one_foot_at(forces, np.array([x, -1e-20, 0.011]))[2] >= of_the_plane - 1e-6


@pytest.mark.parametrize("ground", TOUCHED, ids=repr)
def test_the_compiled_touch_of_every_ground_is_the_one_in_python(ground: Ground) -> None:
    forces = RobotForces(ROBOT, ground, np.zeros(12))
    random = np.random.default_rng(0)
    stiffness, radius = ROBOT.contact.stiffness, ROBOT.contact.foot_radius
    touched = 0
    for _ in range(200):
        x, y = random.uniform(-0.3, 0.3, 2)
        place = np.array([x, y, random.uniform(radius - 0.002, radius + ground.top + 0.001)])
        found = ground.contacts(place, radius)
        expected = ground.rotation() @ (stiffness * found[:, 3] @ found[:, :3])
        world = ground.rotation() @ place
        np.testing.assert_allclose(one_foot_at(forces, world), expected, atol=1e-6)
        touched += len(found) > 0
    assert touched > 20
