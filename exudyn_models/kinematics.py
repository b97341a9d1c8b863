"""Where the feet are and how the leg joints move them, for all legs at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from exudyn_models.description import Array, RobotDescription


@dataclass(frozen=True)
class LegState:
    """Feet and joint axes in the trunk frame.

    Args:
        foot: centres of the foot balls [m], shape (n_legs, 3).
        pivots: abduction, hip and knee joint positions [m], shape (n_legs, 3, 3).
        axes: unit vectors of their rotation axes, shape (n_legs, 3, 3).
    """

    foot: Array
    pivots: Array
    axes: Array

    def jacobian(self, point: Array) -> Array:
        """Velocity of a point of the tibia per joint rate [m], shape (n_legs, 3, 3).

        Args:
            point: position in the trunk frame [m], shape (n_legs, 3). Columns of the result are
                axis x (point - pivot), one per joint.
        """
        columns = np.cross(self.axes, point[:, None, :] - self.pivots)
        return np.swapaxes(columns, 1, 2)


class Kinematics:
    """Forward kinematics of every leg of a robot."""

    def __init__(self, robot: RobotDescription) -> None:
        """Collect the geometry of the legs of ``robot``."""
        legs = robot.legs
        self._mount = np.array([leg.mount for leg in legs])
        self._hip_offset = np.array([leg.outward(leg.hip_offset) for leg in legs])
        self._femur = np.array([leg.femur_length for leg in legs])
        self._tibia = np.array([leg.tibia_length for leg in legs])
        self._femur_angle = np.array([leg.femur_angle for leg in legs])
        self._tibia_angle = np.array([leg.tibia_angle for leg in legs])

    def legs(self, angles: Array) -> LegState:
        """Feet and joint axes at the given joint angles.

        Args:
            angles: abduction, hip and knee relative to the reference pose [rad], shape
                (n_legs, 3); hip and knee positive forward, as the controller counts them.
        """
        abduction, hip, knee = angles.T
        roll = _rotation_x(abduction)
        femur_tilt = hip - self._femur_angle
        tibia_tilt = femur_tilt + knee + self._tibia_angle
        hip_pivot = self._mount + _apply(roll, self._hip_offset)
        knee_pivot = hip_pivot + _apply(roll, _hanging(self._femur, femur_tilt))
        foot = knee_pivot + _apply(roll, _hanging(self._tibia, tibia_tilt))
        pitch_axis = -roll[:, :, 1]
        roll_axis = np.broadcast_to([1.0, 0.0, 0.0], pitch_axis.shape)
        return LegState(
            foot,
            np.stack([self._mount, hip_pivot, knee_pivot], axis=1),
            np.stack([roll_axis, pitch_axis, pitch_axis], axis=1),
        )


def rotation_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """Rotation from trunk to world, Rz(yaw) Ry(pitch) Rx(roll), shape (3, 3)."""
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def _rotation_x(angle: Array) -> Array:
    cos, sin, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    rows = [[one, zero, zero], [zero, cos, -sin], [zero, sin, cos]]
    return np.moveaxis(np.array(rows), -1, 0)


def _apply(rotation: Array, vector: Array) -> Array:
    return np.asarray(np.einsum("lij,lj->li", rotation, vector))


def _hanging(length: Array, tilt: Array) -> Array:
    """A rod that hangs down and is swung forward by ``tilt``."""
    direction = np.stack([np.sin(tilt), np.zeros_like(tilt), -np.cos(tilt)], axis=1)
    return np.asarray(length[:, None] * direction)
