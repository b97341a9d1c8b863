"""Where trunk, legs and feet of a robot were, for the drawing."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from exudyn_models.ground import Surface
from exudyn_models.robot import RobotDescription

Array = NDArray[np.float64]


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


def in_ground(ground: Surface, points: Array) -> Array:
    """Points of the world in the frame of the ground [m], shape (..., 3)."""
    return points @ ground.rotation()


def clearance(
    ground: Surface, robot: RobotDescription, plant: Mapping[str, Array], at: NDArray[np.intp]
) -> Array:
    """Height of the lowest point of every foot over the ground below it [m], shape (len(at), n)."""
    x, y, z = np.moveaxis(in_ground(ground, plant["foot_position"][at]), -1, 0)
    below = [ground.elevation(*leg) for leg in zip(x.T, y.T, strict=True)]
    return z - robot.contact.foot_radius - np.stack(below, axis=1)


def leg_chains(robot: RobotDescription, plant: Mapping[str, Array], at: NDArray[np.intp]) -> Array:
    """Points of every leg in the world frame [m], shape (len(at), n, 4, 3): hip1, hip2, knee, foot.

    Args:
        robot: what walked.
        plant: its channels; trunk pose, joint angles and foot positions are used.
        at: which samples.

    Forward kinematics with positive hip and knee angles swinging the leg forward. The foot is the
    recorded one, so a wrong robot shows as a leg of the wrong length, not as a floating foot.
    """
    abduction, hip, _ = np.moveaxis(plant["joint_angle"][at], -1, 0)
    legs = robot.legs
    lean = hip - np.array([leg.femur_angle for leg in legs])
    hip1 = np.broadcast_to(np.array([leg.mount for leg in legs]), (*lean.shape, 3))
    to_hip2 = np.broadcast_to(np.array([leg.outward(leg.hip_offset) for leg in legs]), hip1.shape)
    femur = np.stack([np.sin(lean), np.zeros_like(lean), -np.cos(lean)], axis=-1)
    to_knee = femur * np.array([[leg.femur_length] for leg in legs])
    hip2 = hip1 + _about_x(abduction, to_hip2)
    in_trunk = np.stack([hip1, hip2, hip2 + _about_x(abduction, to_knee)], axis=2)
    turn, origin = rotation(plant["rpy"][at]), plant["position"][at, None, None]
    in_world = origin + np.einsum("tij,tnkj->tnki", turn, in_trunk)
    return np.concatenate([in_world, plant["foot_position"][at, :, None]], axis=2)


def _about_x(angle: Array, vector: Array) -> Array:
    x, y, z = np.moveaxis(vector, -1, 0)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([x, c * y - s * z, s * y + c * z], axis=-1)
