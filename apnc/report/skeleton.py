"""Where a robot's hips and knees were in a run, for the drawing."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from apnc.loop.recording import Record
from exudyn_models.robot.model import RobotDescription

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


def leg_chains(record: Record, robot: RobotDescription | None) -> Array:
    """Points of every leg in the world frame [m], shape (T, n, 4, 3): hip1, hip2, knee, foot.

    Args:
        record: the run; trunk pose, joint angles and foot positions are used.
        robot: geometry of the legs; None draws straight legs from points above the feet.

    Raises:
        ValueError: the robot does not have every leg of the record.

    Forward kinematics with positive hip and knee angles swinging the leg forward. The foot is the
    recorded one, so a wrong robot shows as a leg of the wrong length, not as a floating foot.
    """
    plant = record.plant
    turn = rotation(plant["rpy"])
    origin = plant["position"][:, None, :]
    feet = plant["foot_position"]
    if robot is None:
        hips = np.broadcast_to(_hips_above_feet(origin, turn, feet), feet.shape)
        in_trunk = np.stack([hips, hips, hips], axis=2)
    else:
        in_trunk = _hips_and_knees(record, robot)
    in_world = origin[:, :, None, :] + np.einsum("tij,tnkj->tnki", turn, in_trunk)
    return np.concatenate([in_world, feet[:, :, None, :]], axis=2)


def trunk_box(record: Record, robot: RobotDescription | None) -> tuple[list[float], list[float]]:
    """Edges and centre of the trunk in its frame [m]; of a box over the feet without a robot."""
    if robot is not None:
        return list(robot.trunk.body.size), list(robot.trunk.center)
    feet = record.plant["foot_position"]
    if len(feet) == 0:
        return [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    turn, origin = rotation(record.plant["rpy"]), record.plant["position"][:, None, :]
    hips = _hips_above_feet(origin, turn, feet)
    length, width = np.ptp(hips, axis=0)[:2]
    return [float(length), float(width), 0.25 * float(width)], [*hips.mean(axis=0).tolist()]


def _hips_and_knees(record: Record, robot: RobotDescription) -> Array:
    """Hip1, hip2 and knee in the trunk frame, shape (T, n, 3, 3)."""
    known = {leg.name: leg for leg in robot.legs}
    missing = [name for name in record.legs if name not in known]
    if missing:
        raise ValueError(f"robot '{robot.name}' has no leg {', '.join(missing)}")
    legs = [known[name] for name in record.legs]
    abduction, hip, _ = np.moveaxis(record.plant["joint_angle"], -1, 0)
    lean = hip - np.array([leg.femur_angle for leg in legs])
    hip1 = np.broadcast_to(np.array([leg.mount for leg in legs]), (*lean.shape, 3))
    to_hip2 = np.broadcast_to(np.array([leg.outward(leg.hip_offset) for leg in legs]), hip1.shape)
    femur = np.stack([np.sin(lean), np.zeros_like(lean), -np.cos(lean)], axis=-1)
    to_knee = femur * np.array([[leg.femur_length] for leg in legs])
    hip2 = hip1 + _about_x(abduction, to_hip2)
    return np.stack([hip1, hip2, hip2 + _about_x(abduction, to_knee)], axis=2)


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
