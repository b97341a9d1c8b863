"""Points of the trunk, legs and feet of a robot in the world, for the animation."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from apnc_core.types import Array
from apnc_plant.ground import Ground
from apnc_plant.robot import Leg, RobotDescription
from apnc_plant.robot.links import links_of

Plant = Mapping[str, Array]


def trunk_corners(robot: RobotDescription, plant: Plant) -> Array:
    """Corners of the trunk [m], shape (T, 8, 3), in the order of ``Trunk.corners``."""
    return _in_world(plant, robot.trunk.corners()[None])


def leg_chains(robot: RobotDescription, plant: Plant) -> Array:
    """Points of every leg [m], shape (T, n, 4, 3): hip1, hip2, knee, foot.

    The foot is the recorded one. With another robot than that of the record, tibias have a wrong
    length but feet stay on the ground.
    """
    angles = np.moveaxis(plant["joint_angle"], 0, -1)
    chains = [_chain(leg, own) for leg, own in zip(robot.legs, angles, strict=True)]
    joints = _in_world(plant, np.concatenate(chains, axis=1))
    joints = joints.reshape(len(joints), len(chains), 3, 3)
    return np.concatenate([joints, plant["foot_position"][:, :, None]], axis=2)


def _chain(leg: Leg, angles: Array) -> Array:
    """Joints of a leg in the trunk [m], shape (T, 3, 3), from its angles, shape (3, T)."""
    frame, at, found = Rotation.identity(), np.zeros((angles.shape[1], 3)), []
    for link in links_of(leg):
        at = at + frame.apply(link.position)
        found.append(at)
        turned = link.turn + link.sign * angles[link.angle]
        frame = frame * Rotation.from_rotvec(np.outer(turned, link.axis))
    return np.stack(found, axis=1)


def trunk_rotation(rpy: Array) -> Array:
    """Rotation from trunk to world, Rz(yaw) Ry(pitch) Rx(roll), shape (T, 3, 3).

    Args:
        rpy: roll, pitch and yaw [rad], shape (T, 3).
    """
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy).T, np.sin(rpy).T
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def in_trunk(plant: Plant, points: Array) -> Array:
    """Points of the world in the frame of the trunk [m], shape (T, ..., 3)."""
    count = len(plant["position"])
    away = points.reshape(count, -1, 3) - plant["position"][:, None]
    seen: Array = (away @ trunk_rotation(plant["rpy"])).reshape(points.shape)
    return seen


def in_ground(ground: Ground, points: Array) -> Array:
    """Points of the world in the frame of the ground [m], shape (..., 3)."""
    return points @ ground.rotation()


def clearance(ground: Ground, robot: RobotDescription, feet: Array) -> Array:
    """Lowest point of every foot over the ground below its centre [m], shape (T, n).

    Args:
        ground: below the feet.
        robot: with the radius of the feet.
        feet: centres of the feet in the world [m], shape (T, n, 3).
    """
    x, y, z = np.moveaxis(in_ground(ground, feet), -1, 0)
    gap: Array = z - robot.foot_radii - ground.elevation(x, y)
    return gap


def _in_world(plant: Plant, points: Array) -> Array:
    """Points of the trunk, shape (T or 1, k, 3), in the world, by Rz(yaw) Ry(pitch) Rx(roll)."""
    turn = trunk_rotation(plant["rpy"])
    placed: Array = plant["position"][:, None] + points @ turn.swapaxes(1, 2)
    return placed
