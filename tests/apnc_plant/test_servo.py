"""The servo, in the formula and in the plants: torque limits, latency, slew rate and work."""

import math
from dataclasses import replace

import numpy as np
import pytest
from plain_robot import plain_robot
from plants import Kind, in_both

from apnc_plant.library import library
from apnc_plant.numbers import servo_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, Servo

TICK = 1 / 60
ROBOT = plain_robot()
SERVO = Servo(
    stiffness=20.0, damping=0.5, stall_torque=4.0, no_load_speed=5.0, reflected_inertia=1.0
)


@pytest.mark.parametrize(
    ("error", "speed", "expected"),
    [
        (0.1, 0.0, 2.0),
        (0.1, 1.0, 1.5),
        (10.0, 0.0, 4.0),
        (10.0, 2.5, 2.0),
        (10.0, 5.0, 0.0),
        (10.0, 7.5, -2.0),
        (10.0, 50.0, -4.0),
        (10.0, -2.5, 4.0),
        (-10.0, 2.5, -4.0),
        (-10.0, -2.5, -2.0),
    ],
)
def test_torque_speed_curve(error: float, speed: float, expected: float) -> None:
    ffi, lib = library()
    servo = ffi.new("plant_servo *", servo_numbers(SERVO))
    assert lib.plant_servo_torque(servo, error, speed) == pytest.approx(expected)


JOINT = {
    "joint_damping": 0.2, "dry_friction": 0.5, "friction_speed": 0.1, "low": -0.3, "high": 0.4,
    "stop_stiffness": 100.0, "stop_damping": 2.0,
}  # fmt: skip


@pytest.mark.parametrize(
    ("angle", "speed", "expected"),
    [
        (0.0, 0.0, 0.0),
        (0.0, 1.0, -0.2 - 0.5),
        (0.0, -2.0, 0.4 + 0.5),
        (0.0, 0.05, -0.01 - 0.25),
        (0.4, 1.0, -0.7),  # at the stop, not beyond it
        (0.45, 0.0, -5.0),
        (0.45, 1.0, -0.7 - 5.0 - 2.0),
        (0.45, -1.0, 0.7 - 5.0 + 2.0),
        (0.4025, 1.0, -0.7 - 0.25 - 1.0),  # half way into where damping sets in
        (0.45, -5.0, 1.5),  # it does not pull
        (-0.35, 0.0, 5.0),
        (-0.35, -1.0, 0.7 + 5.0 + 2.0),
        (-0.35, 5.0, -1.5),
    ],
)
def test_a_joint_is_damped_rubs_and_stops(angle: float, speed: float, expected: float) -> None:
    ffi, lib = library()
    joint = ffi.new("plant_joint *", JOINT)
    assert lib.plant_joint_torque(joint, angle, speed) == pytest.approx(expected)


@in_both
@pytest.mark.parametrize(
    ("stops", "held", "joint"),
    [
        ({"femur_range": (0.65, 1.5)}, 0.1, 1), ({"femur_range": (-1.0, 0.85)}, -0.1, 1),
        ({"tibia_range": (0.5, 1.7)}, 0.09, 2), ({"tibia_range": (1.55, 2.0)}, -0.05, 2),
    ],
)  # fmt: skip
def test_a_joint_stops_at_its_range(
    kind: Kind, stops: dict[str, tuple[float, float]], held: float, joint: int
) -> None:
    legs = tuple(replace(leg, **stops) for leg in ROBOT.legs)
    plant = kind(replace(ROBOT, legs=legs), options=PlantOptions(gravity=0.0, clearance=1.0))
    commands = np.zeros((2, 4))
    commands[joint - 1] = math.copysign(0.5, held)
    for _ in range(90):
        plant.advance(*commands, TICK)
    sample = plant.sample()
    reached = sample["joint_angle"][:, joint]
    stop = next(s for s in legs[0].stops[joint] if s * held > 0.0)
    beyond = (reached - stop) * math.copysign(1.0, held)
    # there the servo pushes as hard as the stop
    push = np.abs(sample["joint_torque"][:, joint])
    np.testing.assert_allclose(beyond * ROBOT.servo.stop[0], push, rtol=1e-3)
    assert abs(stop - held) < 0.05


def weightless(servo: Servo) -> RobotDescription:
    return replace(ROBOT, servo=servo)


def swing_knees(kind: Kind, servo: Servo, target: float, duration: float) -> dict[str, np.ndarray]:
    options = PlantOptions(gravity=0.0, clearance=1.0, step=1e-4)
    plant = kind(weightless(servo), options=options)
    plant.advance(np.zeros(4), np.full(4, target), duration)
    return plant.sample()


@in_both
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_plant_stops_at_the_stall_torque(kind: Kind, side: float) -> None:
    # A rotor this heavy is all that resists, and stays far below the no-load speed.
    servo = replace(SERVO, reflected_inertia=100.0, no_load_speed=500.0)
    sample = swing_knees(kind, servo, target=side * 100.0, duration=0.5)
    np.testing.assert_allclose(sample["joint_speed"][:, 2], side * 4.0 / 100.0 * 0.5, rtol=0.005)


@in_both
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_plant_follows_the_torque_speed_curve(kind: Kind, side: float) -> None:
    # I w' = T (1 - w/w0) has the solution w = w0 (1 - exp(-T t / (I w0))).
    servo = replace(SERVO, reflected_inertia=2.0)
    sample = swing_knees(kind, servo, target=side * 100.0, duration=2.0)
    speed = 5.0 * (1.0 - np.exp(-4.0 * 2.0 / (2.0 * 5.0)))
    torque = 4.0 * (1.0 - speed / 5.0)
    np.testing.assert_allclose(sample["joint_speed"][:, 2], side * speed, rtol=0.01)
    np.testing.assert_allclose(sample["joint_torque"][:, 2], side * torque, rtol=0.02)


@in_both
def test_within_the_limits_a_plant_is_a_damped_spring(kind: Kind) -> None:
    # I q'' = P (target - q) - D q', started at rest.
    servo = replace(SERVO, damping=4.0, reflected_inertia=10.0, no_load_speed=500.0)
    decay, frequency = 4.0 / 20.0, np.sqrt(20.0 / 10.0 - (4.0 / 20.0) ** 2)
    t = 1.0
    envelope = np.cos(frequency * t) + decay / frequency * np.sin(frequency * t)
    expected = 0.1 * (1.0 - np.exp(-decay * t) * envelope)
    sample = swing_knees(kind, servo, target=0.1, duration=t)
    np.testing.assert_allclose(sample["joint_angle"][:, 2], expected, rtol=0.01)


@in_both
def test_positive_targets_swing_the_leg_forward_and_lift_the_foot(kind: Kind) -> None:
    options = PlantOptions(gravity=0.0, clearance=1.0)
    plant = kind(ROBOT, options=options)
    before = plant.sample()["foot_position"] - plant.sample()["position"]
    for _ in range(60):
        plant.advance(np.full(4, 0.2), np.zeros(4), 1 / 60)
    hip = plant.sample()["foot_position"] - plant.sample()["position"]
    assert (hip[:, 0] > before[:, 0] + 0.01).all()
    for _ in range(60):
        plant.advance(np.zeros(4), np.full(4, 0.2), 1 / 60)
    knee = plant.sample()["foot_position"] - plant.sample()["position"]
    assert (knee[:, 2] > before[:, 2] + 0.01).all()


@in_both
@pytest.mark.parametrize("latency", [0.004, TICK, 0.04])
def test_a_command_takes_effect_after_the_latency(kind: Kind, latency: float) -> None:
    late = replace(ROBOT, servo=replace(ROBOT.servo, latency=latency))
    options = PlantOptions(gravity=0.0, clearance=0.5, step=1e-4)
    delayed, prompt = kind(late, options=options), kind(ROBOT, options=options)
    angles = []
    for plant, length in ((delayed, 0.1), (prompt, 0.1 - latency)):
        ticks = 1 if plant is prompt else 4
        for _ in range(ticks):
            plant.advance(np.zeros(4), np.full(4, 0.3), length / ticks)
        angles.append(plant.sample()["joint_angle"])
    assert angles[1][0, 2] > 0.01
    np.testing.assert_allclose(angles[0], angles[1], atol=1e-3)


@in_both
def test_a_slew_rate_limits_how_fast_a_command_moves(kind: Kind) -> None:
    slow = replace(ROBOT, servo=replace(ROBOT.servo, slew_rate=1.0))
    limited, ramped = kind(slow), kind(ROBOT)
    step = np.full(4, 0.2)
    for tick in range(1, 25):
        limited.advance(step, np.zeros(4), TICK)
        ramped.advance(np.minimum(step, 1.0 * tick * TICK), np.zeros(4), TICK)
        np.testing.assert_allclose(
            limited.sample()["joint_angle"], ramped.sample()["joint_angle"], atol=1e-12
        )
    assert limited.sample()["joint_angle"][:, 1].min() > 0.1


@in_both
def test_recorded_work_is_that_of_every_step(kind: Kind) -> None:
    # Torque times speed once per tick misses a tenth of it: torques peak between two ticks.
    plant = kind(ROBOT)
    summed = 0.0
    for tick in range(60):
        side = np.array([1.0, -1.0, -1.0, 1.0])
        hip = 0.13 * math.sin(0.12 * tick) * side
        knee = 0.08 * math.cos(0.12 * tick) * side
        for _ in range(64):
            plant.advance(hip, knee, TICK / 64)
            sample = plant.sample()
            power = np.abs(sample["joint_torque"] * sample["joint_speed"]).sum()
            summed += power * TICK / 64
    assert summed > 0.5
    assert plant.sample()["joint_work"].sum() == pytest.approx(summed, rel=0.01)
