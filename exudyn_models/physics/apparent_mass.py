"""Apparent mass of the feet along the ground."""

from __future__ import annotations

import numpy as np

from apnc_plant.robot.model import Array
from exudyn_models.physics.robot_forces import RobotForces

_STEP = 1e-6  # of the central differences [m, rad]


def apparent_mass(forces: RobotForces, q: Array, mass: Array, along: Array) -> float:
    """Least apparent mass of any foot in any direction along the ground [kg].

    1 / the largest eigenvalue of T' J M^-1 J' T, with J the Jacobian of the foot centre: force over
    acceleration of a foot that is pushed sideways, with the other feet free (Khatib, 1987).

    Args:
        forces: know where the feet are.
        q: coordinates, shape (6 + 3 n_legs,).
        mass: mass matrix M there.
        along: T, two unit vectors along the ground as columns, world frame, shape (3, 2).
    """
    still = np.zeros_like(q)

    def feet(at: Array) -> Array:
        forces.measure(at, still)
        return forces.foot.copy()

    moved = [feet(q + step) - feet(q - step) for step in _STEP * np.eye(q.size)]
    jacobian = np.array(moved).T.reshape(-1, 3, q.size) / (2.0 * _STEP)
    sideways = along.T @ jacobian
    mobility = sideways @ np.linalg.solve(mass, sideways.transpose(0, 2, 1))
    return 1.0 / float(np.linalg.eigvalsh(mobility).max())
