"""A made-up run with known answers: legs moved by formulas, not by a simulation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from apnc.loop.experiment import Experiment
from apnc.loop.record import End, Record
from apnc_core.types import Array
from apnc_plant.robot import RobotDescription, load_robot

QUADRUPED = ("RF", "RH", "LF", "LH")
HEXAPOD = ("RF", "RM", "RH", "LF", "LM", "LH")
OCTOPOD = ("RF", "RA", "RB", "RH", "LF", "LA", "LB", "LH")
TROT = (np.pi, np.pi, 0.0)
TRIPOD = (np.pi, 0.0, np.pi, 0.0, np.pi)

RATE = 60.0
FEMUR, TIBIA = 0.070, 0.085
HIP_X, HIP_Y, HIP_Z = 0.092, 0.066, -0.03
FOOT_RADIUS, LIFT, HEIGHT = 0.012, 0.015, 0.148
MASS, G = 2.5, 9.81


def outputs(phase: Array) -> tuple[Array, Array]:
    """Outputs o1, o2 of oscillators that run on a circle with the given phase [rad]."""
    return np.cos(phase), -np.sin(phase)


def steady(phases: Sequence[float], seconds: float = 10.0) -> tuple[Array, Array, Array]:
    """Time, o1 and o2 of oscillators at 1.4 Hz with constant relative phases."""
    t = np.arange(round(seconds * RATE)) / RATE
    return t, *outputs(2 * np.pi * 1.4 * t[:, None] + np.array([0.0, *phases]))


def synthetic_record(
    duration: float = 20.0,
    phases: Sequence[float] = TROT,
    *,
    frequency: float = 1.4,
    duty: float = 0.6,
    speed: float = 0.08,
    yaw: float = 0.0,
    formation: tuple[float, float] | None = None,
    roll_amplitude: float = 0.02,
    pitch_amplitude: float = 0.01,
    air_time: float = 0.0,
    complete: bool = True,
) -> Record:
    """Steady walk with the given relative phases, duty factor and speed.

    ``formation=(t0, t1)`` starts in phase and moves to ``phases`` between t0 and t1. No foot is
    loaded before ``air_time``. Four legs; six if five phases are given, eight if seven.
    """
    legs = {5: HEXAPOD, 7: OCTOPOD}.get(len(phases), QUADRUPED)
    experiment = Experiment(
        robot="lilibot" if legs == QUADRUPED else "hexapod", duration=max(duration, 1 / RATE)
    )
    n = len(legs)
    t = np.arange(round(duration * RATE)) / RATE
    lead = _lead(t, np.array([0.0, *phases]), formation)
    theta = 2 * np.pi * frequency * t[:, None] + lead
    o1, o2 = 0.88 * np.cos(theta), -0.88 * np.sin(theta)

    travelled = np.stack([speed * t * np.cos(yaw), speed * t * np.sin(yaw)], axis=1)
    position = np.column_stack([travelled, np.full_like(t, HEIGHT)])
    sway = 2 * np.pi * frequency * t
    rpy = np.column_stack(
        [roll_amplitude * np.sin(sway), pitch_amplitude * np.sin(2 * sway), np.full_like(t, yaw)]
    )
    standing, force = _loads(theta, duty, n, t >= air_time)
    feet_trunk = _feet(theta, duty, speed / frequency, legs)
    feet = position[:, None] + np.einsum("ij,tnj->tni", _turn(yaw), feet_trunk)
    angle = _joint_angles(feet_trunk, legs, experiment.description)
    spin = np.gradient(angle, 1 / RATE, axis=0) if len(t) > 1 else np.zeros_like(angle)
    torque = 0.6 * np.sin(theta)[..., None] * np.array([0.1, 1.0, 0.7])
    grf = np.maximum(force[..., 2], 0.0)
    settled = np.exp(-t / 4)
    gamma = 0.02 + 0.2 * settled[:, None] * (1 + 0.3 * np.sin(theta))
    phi = np.angle(np.exp(1j * lead[:, 1:])) + 0.08 * np.sin(2 * theta[:, 1:])
    return Record(
        legs=legs,
        time=t,
        signals={
            "position": position,
            "rpy": rpy,
            "velocity": np.gradient(position, 1 / RATE, axis=0) if len(t) > 1 else 0 * position,
            "joint_angle": angle,
            "joint_speed": spin,
            "joint_torque": torque,
            "joint_work": np.cumsum(np.abs(torque * spin), axis=0) / RATE,
            "foot_position": feet,
            "foot_force": force,
            "grf": grf,
            "o1": o1,
            "o2": o2,
            "theta_hip": 0.13 * o1 - 0.11,
            "theta_knee": 0.08 * o2 - 0.04,
            "gamma": gamma,
            "grf_expected": 0.9 * standing,
            **{name: 0.01 * np.sin(theta) for name in ("f1", "f2", "g1", "g2")},
            "fault": np.zeros((len(t), n)),
            "phi": phi,
            "phi_memory": np.broadcast_to(lead[-1:, 1:], phi.shape) if len(t) else phi,
            "d": 2.0 * settled,
            "kappa": np.where(2.0 * settled < 0.4, 1.0, 0.0),
            "MI": np.full_like(t, 0.08),
            "turn": np.zeros_like(t),
            "reset": np.zeros_like(t),
        },
        mass=MASS,
        experiment=experiment,
        robot=load_robot(str(experiment.robot)),
        end=End.complete if complete else End.interrupted,
        fmu_wall_s=0.05 * duration / 10,
        wall_s=duration / 10,
    )


def _lead(t: Array, phases: Array, formation: tuple[float, float] | None) -> Array:
    """Phase lead of every leg over leg 1, shape (T, n)."""
    if formation is None:
        return np.broadcast_to(phases, (len(t), len(phases))).copy()
    start, end = formation
    return np.clip((t - start) / (end - start), 0.0, 1.0)[:, None] * phases


def _cycle(theta: Array, duty: float) -> tuple[NDArray[np.bool_], Array]:
    """Stance flag, and progress through the stance or the swing in [0, 1)."""
    # Stance is centred on theta = pi/2, where o1 falls fastest and the hip swings back.
    u = ((theta - np.pi / 2) / (2 * np.pi) + duty / 2) % 1.0
    standing = u < duty
    return standing, np.where(standing, u / duty, (u - duty) / (1 - duty))


def _loads(
    theta: Array, duty: float, n: int, grounded: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], Array]:
    """Half-sine loads whose mean over a cycle is the weight shared among the legs."""
    standing, progress = _cycle(theta, duty)
    standing = standing & grounded[:, None]
    peak = MASS * G / n / duty * np.pi / 2
    vertical = np.where(standing, peak * np.sin(np.pi * progress), 0.0)
    fore = -0.15 * vertical * np.cos(np.pi * progress)
    return standing, np.stack([fore, 0 * vertical, vertical], axis=-1)


def _hips(legs: Sequence[str]) -> Array:
    x = {"F": HIP_X, "A": HIP_X / 3, "M": 0.0, "B": -HIP_X / 3, "H": -HIP_X}
    y = {"R": -HIP_Y, "L": HIP_Y}
    return np.array([[x[leg[1]], y[leg[0]], HIP_Z] for leg in legs])


def _feet(theta: Array, duty: float, stride: float, legs: Sequence[str]) -> Array:
    """Foot positions in a frame that moves with the trunk but does not tilt, shape (T, n, 3)."""
    standing, progress = _cycle(theta, duty)
    reach = duty * stride / 2
    back_and_forth = np.where(
        standing, reach * (1 - 2 * progress), -reach * np.cos(np.pi * progress)
    )
    lift = np.where(standing, 0.0, LIFT * np.sin(np.pi * progress))
    feet = np.broadcast_to(_hips(legs), (*theta.shape, 3)).copy()
    feet[..., 0] += back_and_forth + 0.01
    feet[..., 2] = lift + FOOT_RADIUS - HEIGHT
    return feet


def _joint_angles(feet: Array, legs: Sequence[str], robot: RobotDescription) -> Array:
    """Two-link inverse kinematics in the plane of the leg, relative to the reference pose."""
    own = robot.legs if len(robot.legs) == len(legs) else [robot.legs[0]] * len(legs)
    reference = np.array([[leg.femur_angle, leg.tibia_angle] for leg in own]).T
    leg = feet - _hips(legs)
    x, down = leg[..., 0], -leg[..., 2]
    reach = np.hypot(x, down)
    cos_knee = (reach**2 - FEMUR**2 - TIBIA**2) / (2 * FEMUR * TIBIA)
    knee = np.arccos(np.clip(cos_knee, -1, 1))
    inner = np.arctan2(TIBIA * np.sin(knee), FEMUR + TIBIA * np.cos(knee))
    femur = np.arctan2(x, down) - inner
    return np.stack([np.zeros_like(x), femur + reference[0], knee - reference[1]], axis=-1)


def _turn(yaw: float) -> Array:
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
