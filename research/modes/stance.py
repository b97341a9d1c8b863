"""A rigid trunk on compliant legs: the loads of the legs when their lengths differ.

Of n legs with lengths L_i and stiffness k_i the trunk takes the height, pitch and roll q that
balance its weight, and the loads are

    F = F_0 + R L,  R = K - K A (A^T K A)^-1 A^T K,  K = diag(k),

A (n, 3) the rise of every hip with heave, pitch and roll. These three patterns of lengths load no
leg (R A = 0), since the trunk follows them. It cannot follow the other n - 3, which load the legs
at once. They are warp (one diagonal against the other) on four legs, and bend, twist and tripod on
six.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription

_NAMES: Final = {
    (0, 1): "heave", (0, -1): "roll", (1, 1): "pitch", (1, -1): "twist", (2, 1): "bend",
    (2, -1): "tripod",
}  # fmt: skip


@dataclass(frozen=True)
class Stance:
    """The feet of a robot, seen from its centre of mass.

    Args:
        x, y: foot ahead and to the left of the centre of mass [m], shape (n,).
        stiffness: vertical force per shortening of a leg [N/m], shape (n,).
        lag: damping over stiffness of the servos [s].
        weight: of the robot [N].
    """

    x: Array
    y: Array
    stiffness: Array
    lag: float
    weight: float

    @property
    def rigid(self) -> Array:
        """A [1, m, m], shape (n, 3): rise of every hip with heave, pitch (nose up) and roll."""
        return np.stack([np.ones_like(self.x), self.x, self.y], axis=1)

    def loads(self) -> Array:
        """R [N/m], shape (n, n): change of every load per change of every leg's length."""
        A, K = self.rigid, np.diag(self.stiffness)
        return np.asarray(K - K @ A @ np.linalg.solve(A.T @ K @ A, A.T @ K))

    def carried(self, legs: Sequence[int]) -> Array:
        """Loads [N], shape (n,), of a robot that stands on these legs alone, all of one length.

        Raises:
            ValueError: fewer than three legs, or a leg that would have to pull.
        """
        A, k = self.rigid[legs], self.stiffness[legs][:, None]
        if len(legs) < 3:
            raise ValueError(f"{len(legs)} legs do not carry a trunk")
        force = (k * A) @ np.linalg.solve(A.T @ (k * A), [self.weight, 0.0, 0.0])
        if (force < 0.0).any():
            raise ValueError("the centre of mass is not over these feet")
        found = np.zeros_like(self.x)
        found[legs] = force
        return found


def stance_of(robot: RobotDescription, side_offset: float = 0.0) -> Stance:
    """The stance of a robot in its reference pose.

    A leg gives at its two servos and at its contact, in series: 1/k = (a_hip^2 + a_knee^2)/P + 1/c
    with a the distance of the foot from the joint along the trunk.

    Args:
        robot: the robot; the masses of its legs count as hanging at their mounts.
        side_offset: sideways error of the trunk's centre of mass [m].
    """
    kinematics = Kinematics(robot)
    points = [kinematics.points(leg, 0.0, 0.0, 0.0) for leg in range(len(robot.legs))]
    hips, knees, feet = np.stack(points, axis=1)
    arms = (feet[:, 0] - hips[:, 0]) ** 2 + (feet[:, 0] - knees[:, 0]) ** 2
    trunk = robot.trunk.loaded(side_offset, 0.0)
    com = trunk.mass * trunk.com + sum(leg.mass * np.array(leg.mount) for leg in robot.legs)
    return Stance(
        x=feet[:, 0] - com[0] / robot.mass,
        y=feet[:, 1] - com[1] / robot.mass,
        stiffness=1.0 / (arms / robot.servo.stiffness + 1.0 / robot.contact.stiffness),
        lag=robot.servo.damping / robot.servo.stiffness,
        weight=robot.weight,
    )


def patterns(n_legs: int) -> dict[str, Array]:
    """Orthonormal patterns over the legs by name, each (n_legs,), legs in the order of the FMU.

    Along a side constant, linear, curved and so on; both sides alike, or opposed.

    Raises:
        ValueError: an odd number of legs.
    """
    if n_legs % 2:
        raise ValueError(f"{n_legs} legs are not two sides alike")
    half = n_legs // 2
    along, _ = np.linalg.qr(np.vander(np.linspace(1.0, -1.0, half), increasing=True))
    along = along * np.sign(along[0]) / np.sqrt(2.0)
    names = {**_NAMES, **({(1, -1): "warp"} if half == 2 else {})}
    return {
        names.get((power, sides), f"{'alike' if sides > 0 else 'opposed'} {power}"):
        np.concatenate([along[:, power], sides * along[:, power]])
        for power in range(half) for sides in (1, -1)
    }  # fmt: skip
