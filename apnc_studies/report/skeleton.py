"""Geometry of the legs, only as far as a drawing needs it, and where it puts hips and knees."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import radians
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from exudyn_models.recording import Record

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Skeleton:
    """Where the legs sit on the trunk and how long their links are.

    Args:
        hips: hip1 of every leg in the trunk frame (x forward, y left, z up) [m], by leg name.
        femur: length from hip2 to knee [m].
        tibia: length from knee to foot [m].
        hip_offset: from hip1 to hip2, forward, outward and up [m].
        femur_angle: femur in the reference pose, forward of straight down [rad].
        knee_angle: tibia in the reference pose, forward of the femur [rad].
        trunk: length, width and height of the trunk box [m].
        trunk_center: centre of the box in the trunk frame [m].
    """

    hips: Mapping[str, tuple[float, float, float]]
    femur: float = 0.070
    tibia: float = 0.085
    hip_offset: tuple[float, float, float] = (0.0, 0.0, -0.03)
    femur_angle: float = radians(-43.0)
    knee_angle: float = radians(92.0)
    trunk: tuple[float, float, float] = (0.26, 0.16, 0.06)
    trunk_center: tuple[float, float, float] = (0.0, 0.0, 0.02)


LILIBOT: Final = Skeleton(
    hips={
        "RF": (0.092, -0.066, 0.0),
        "RH": (-0.092, -0.066, 0.0),
        "LF": (0.092, 0.066, 0.0),
        "LH": (-0.092, 0.066, 0.0),
    }
)


def rotation(rpy: ArrayLike) -> Array:
    """Rotation matrices from the trunk to the world frame, Rz(yaw) Ry(pitch) Rx(roll).

    Args:
        rpy: roll, pitch, yaw [rad], shape (T, 3).

    Returns:
        Shape (T, 3, 3).
    """
    angles = np.asarray(rpy, dtype=np.float64)
    (cr, cp, cy), (sr, sp, sy) = np.cos(angles).T, np.sin(angles).T
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def leg_chains(record: Record, skeleton: Skeleton | None) -> Array:
    """Points of every leg in the world frame [m], shape (T, n, 4, 3): hip1, hip2, knee, foot.

    Args:
        record: the run; trunk pose, joint angles and foot positions are used.
        skeleton: geometry of the legs; None draws straight legs from points above the feet.

    Raises:
        ValueError: the skeleton does not name every leg of the record.

    Forward kinematics with positive hip and knee angles swinging the leg forward. The foot is the
    recorded one, so a wrong skeleton shows as a leg of the wrong length, not as a floating foot.
    """
    plant = record.plant
    turn = rotation(plant["rpy"])
    origin = plant["position"][:, None, :]
    feet = plant["foot_position"]
    if skeleton is None:
        hips = np.broadcast_to(_hips_above_feet(origin, turn, feet), feet.shape)
        in_trunk = np.stack([hips, hips, hips], axis=2)
    else:
        in_trunk = _hips_and_knees(record, skeleton)
    in_world = origin[:, :, None, :] + np.einsum("tij,tnkj->tnki", turn, in_trunk)
    return np.concatenate([in_world, feet[:, :, None, :]], axis=2)


def _hips_and_knees(record: Record, skeleton: Skeleton) -> Array:
    """Hip1, hip2 and knee in the trunk frame, shape (T, n, 3, 3)."""
    missing = [leg for leg in record.legs if leg not in skeleton.hips]
    if missing:
        raise ValueError(f"the skeleton has no hip for leg {', '.join(missing)}")
    hip1 = np.array([skeleton.hips[leg] for leg in record.legs])
    outward = np.sign(hip1[:, 1])
    abduction, hip, _ = np.moveaxis(record.plant["joint_angle"], -1, 0)
    femur = skeleton.femur_angle + hip
    zero = np.zeros_like(femur)
    fore, side, up = skeleton.hip_offset
    to_hip2 = np.stack([zero + fore, zero + outward * side, zero + up], axis=-1)
    to_knee = skeleton.femur * np.stack([np.sin(femur), zero, -np.cos(femur)], axis=-1)
    hip1_all = np.broadcast_to(hip1, to_hip2.shape)
    hip2 = hip1_all + _about_x(abduction, to_hip2)
    return np.stack([hip1_all, hip2, hip2 + _about_x(abduction, to_knee)], axis=2)


def _about_x(angle: Array, vector: Array) -> Array:
    x, y, z = np.moveaxis(vector, -1, 0)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([x, c * y - s * z, s * y + c * z], axis=-1)


def _hips_above_feet(origin: Array, turn: Array, feet: Array) -> Array:
    """Mean foot positions in the trunk frame, lifted to the trunk's height, shape (n, 3)."""
    if len(feet) == 0:
        return np.zeros(feet.shape[1:])
    mean: Array = np.einsum("tji,tnj->tni", turn, feet - origin).mean(axis=0)
    mean[:, 2] = 0.0
    return mean
