"""Motion of the plant in C against closed form and conservation laws, at the default step too."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from c_plant import (
    PLAIN_LEG,
    STEP,
    TICK,
    CPlant,
    changed,
    lib,
    plane,
    random_fields,
    random_robot,
    robot_of,
    same_bits,
    soft_robot,
    trot,
)
from c_plant_checks import QUIET, kinds, random_motion
from rigid_body import BASE, RigidBody

GRAVITY = 9.81
MASS, STIFFNESS, RADIUS, LENGTH = 2.0, 1000.0, 0.01, 0.1
FREE = {"stiffness": 0.0, "damping": 0.0}


def hopper(damping: float = 0.0) -> Any:
    """A trunk of 2 kg on four straight legs without mass: it moves up and down on its feet."""
    fields = random_fields(np.random.default_rng(1), 4)
    none = {"mass": 0.0, "com": [0.0] * 3, "inertia": [0.0] * 6}
    straight = {"femur_angle": 0.0, "tibia_angle": 0.0, "femur": LENGTH, "tibia": LENGTH}
    legs = [
        straight | {"mount": [x, y, 0.0], "hip": [0.0] * 3, "link": [none] * 3} | PLAIN_LEG
        for y in (-0.1, 0.1)
        for x in (0.1, -0.1)
    ]
    trunk = {"mass": MASS, "com": [0.0] * 3, "inertia": [0.01, 0.02, 0.03, 0.0, 0.0, 0.0]}
    rubber = {"stiffness": STIFFNESS, "damping": damping, "damping_depth": 1e-12, "friction": 0.0}
    return robot_of(
        changed(
            fields,
            leg=legs,
            trunk=trunk,
            gravity=GRAVITY,
            sensor=QUIET,
            contact=rubber | {"foot_radius": RADIUS},
        )
    )


def bounce(step: float, damping: float, time: float) -> float:
    """Error of the height of the hopper that is let go with its feet just touching [m]."""
    plant = CPlant(4)
    plant.place(hopper(damping), plane())
    plant.advance(time, step)
    k, c = 4 * STIFFNESS / MASS, 4 * damping / MASS
    w = math.sqrt(k - c * c / 4)
    decay = math.exp(-c / 2 * time)
    rest = GRAVITY / k
    stretch = rest * decay * (math.cos(w * time) + c / (2 * w) * math.sin(w * time))
    return float(plant.sample()["position"][2] - (2 * LENGTH + RADIUS - rest + stretch))


def test_forces_of_place_are_integrated_at_second_order_forces_of_speed_at_first() -> None:
    for damping, order in ((0.0, 2.0), (3.0, 1.0)):
        coarse, fine = (abs(bounce(0.1 / n, damping, 0.1)) for n in (400, 800))
        assert math.log2(coarse / fine) == pytest.approx(order, abs=0.05)
        assert fine < 1e-5


def test_a_spinning_robot_in_flight_is_integrated_at_first_order() -> None:
    # Coriolis terms are forces of speed.
    robot = random_robot(2, 4, servo=FREE)
    ends = []
    for steps in (500, 1000, 2000):
        plant = CPlant(4)
        plant.place(robot, plane(), clearance=10.0)
        q, _ = plant.get()
        plant.put(q, random_motion(np.random.default_rng(2), 4)[1])
        plant.advance(0.1, 0.1 / steps)
        ends.append(plant.get()[0])
    coarse, fine = (np.abs(np.subtract(*pair)).max() for pair in (ends[:2], ends[1:]))
    assert math.log2(coarse / fine) == pytest.approx(1.0, abs=0.05)


def test_free_fall_is_exact_at_the_default_step() -> None:
    robot = random_robot(3, 5, gravity=GRAVITY)
    plant = CPlant(5)
    plant.place(robot, plane(), clearance=1.0)
    start = plant.sample()["position"].copy()
    for _ in range(18):
        plant.advance()
    sample = plant.sample()
    expected = [0.0, 0.0, GRAVITY * 0.3**2 / 2]
    np.testing.assert_allclose(start - sample["position"], expected, atol=1e-13)
    np.testing.assert_allclose(sample["velocity"], [0.0, 0.0, -GRAVITY * 0.3], atol=1e-13)


def without_step(coarse: Any, fine: Any) -> Any:
    """What is left of an error of first order at an eighth of a step, extrapolated to none."""
    return (8.0 * fine - coarse) / 7.0


def energy(body: RigidBody, plant: CPlant, target: np.ndarray) -> float:
    """Kinetic, potential and that of the springs in joints and feet [J]."""
    q, v = plant.get()
    robot = body.robot
    springs = robot.servo.stiffness * ((q[BASE:] - target) ** 2).sum()
    depth = robot.contact.foot_radius - plant.sample()["foot"][:, 2]
    springs += robot.contact.stiffness * (np.maximum(depth, 0.0) ** 2).sum()
    return body.energy(q, v) + float(springs) / 2.0


def lossless(seed: int) -> Any:
    strong = {"damping": 0.0, "stall_torque": 1e6, "no_load_speed": 1e9}
    return soft_robot(seed, 4, servo=strong, contact={"damping": 0.0, "friction": 0.0})


def drift(height: float, spin: float, step: float) -> tuple[float, float]:
    """Energy gained in half a second without losses, and what the motion has at the start [J]."""
    plant, robot = CPlant(4), lossless(4)
    body = RigidBody(robot.at)
    plant.place(robot, plane(), clearance=height)
    q, _ = plant.get()
    v = spin * random_motion(np.random.default_rng(4), 4)[1]
    plant.put(q, v)
    target = q[BASE:].copy()
    start = energy(body, plant, target)
    moving = v @ body.mass_matrix(q) @ v / 2.0 + body.robot.weight * min(height, 0.01)
    for _ in range(20):
        plant.command(*(-target.reshape(-1, 3)[:, 1:].T))
        plant.advance(0.025, step)
    return energy(body, plant, target) - start, moving


@pytest.mark.parametrize(("height", "spin"), [(3.0, 1.0), (0.01, 0.0)], ids=["flight", "ground"])
def test_without_losses_energy_is_kept(height: float, spin: float) -> None:
    coarse, moving = drift(height, spin, STEP / 4)
    fine, _ = drift(height, spin, STEP / 32)
    assert abs(coarse) < 0.05 * moving
    assert abs(without_step(coarse, fine)) < 1e-5 * moving


def test_servos_change_no_momentum_in_the_air() -> None:
    robot, errors = random_robot(5, 4, gravity=GRAVITY), []
    for step in (STEP, STEP / 8):
        plant, body = CPlant(4), RigidBody(robot.at)
        plant.place(robot, plane(), clearance=5.0)
        mass = body.mass_matrix(plant.get()[0])[0, 0]
        for tick in range(30):
            plant.tick(*trot(4, tick, 3.0), step)
        linear, angular = body.momentum(*plant.get())
        errors.append(np.array([*(linear - [0.0, 0.0, -mass * GRAVITY * 30 * TICK]), *angular]))
    assert np.abs(errors[0][:3]).max() < 1e-3 and np.abs(errors[0][3:]).max() < 1e-4
    assert (np.abs(without_step(*errors)) < 0.05 * np.abs(errors[0])).all()


def test_momentum_changes_by_the_forces_on_the_feet_and_weight() -> None:
    robot, worst = soft_robot(6, 4, gravity=GRAVITY), []
    for parts in (16, 128):
        plant, body = CPlant(4), RigidBody(robot.at)
        plant.place(robot, plane())
        mass = body.mass_matrix(plant.get()[0])[0, 0]
        impulse, h = np.zeros(3), TICK / parts
        before = plant.sample()["force"].sum(axis=0)
        for tick in range(20):
            for _ in range(parts):
                plant.command(*trot(4, tick))
                plant.advance(h, h)
                after = plant.sample()["force"].sum(axis=0)
                impulse += h * ((before + after) / 2.0 - [0.0, 0.0, mass * GRAVITY])
                before = after
        linear, _ = body.momentum(*plant.get())
        worst.append(float(np.abs(linear - impulse).max()) / (mass * GRAVITY))
    assert worst[0] < 2e-3 and worst[1] < 0.3 * worst[0]


def test_work_is_power_over_time() -> None:
    robot, summed = random_robot(7, 4), np.zeros((4, 3))
    plant, h = CPlant(4), TICK / 64
    plant.place(robot, plane())
    for tick in range(30):
        for _ in range(64):
            plant.command(*trot(4, tick))
            plant.advance(h, h)
            sample = plant.sample()
            summed += np.abs(sample["torque"] * sample["speed"]) * h
    assert np.median(summed) > 0.1
    np.testing.assert_allclose(plant.sample()["work"], summed, rtol=0.02, atol=1e-4)


def test_a_tick_is_the_sum_of_its_halves() -> None:
    robot = random_robot(8, 4)
    whole, halves = CPlant(4), CPlant(4)
    for plant in (whole, halves):
        plant.place(robot, plane())
    for tick in range(60):
        for plant, parts in ((whole, 1), (halves, 2)):
            plant.command(*trot(4, tick))
            for _ in range(parts):
                plant.advance(TICK / parts)
        for one, other in zip(whole.get(), halves.get(), strict=True):
            assert same_bits(one, other)


@pytest.mark.parametrize("kind", [(0, 0), *kinds(lib())], ids=str)
def test_bytes_put_back_go_on_with_the_same_bits(kind: tuple[int, int]) -> None:
    legs, late = 5, {"latency": 0.03}
    plant = CPlant(legs, kind=kind[0], level=kind[1], delay=0.05)
    other = CPlant(legs, kind=kind[0], level=kind[1], delay=0.05)
    for each in (plant, other):
        for lane in range(plant.lanes):
            robot = random_robot(9 + lane, legs, servo=late, sensor={"delay": 0.05, "noise": 0.1})
            each.place(robot, plane(), lane, seed=lane)

    def walk(which: CPlant, first: int) -> np.ndarray:
        rows = []
        for tick in range(first, first + 25):
            for lane in range(which.lanes):
                which.command(*trot(legs, tick), lane)
            which.advance()
            rows.append([which.row(lane) for lane in range(which.lanes)])
        return np.array(rows)

    walk(plant, 0)
    saved = plant.bytes()
    on = walk(plant, 25)
    walk(plant, 50)
    plant.restore(saved)
    assert same_bits(walk(plant, 25), on)
    other.restore(saved)
    assert same_bits(walk(other, 25), on)
    made = (*kind, legs, 0, lib().plant_history(0.05, 0.05, TICK))
    assert lib().plant_intact(other.memory, *made)
