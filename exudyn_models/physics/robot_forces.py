"""The compiled forces bound to one robot, one ground and its present condition."""

from __future__ import annotations

import math
import struct
from typing import Any

import numpy as np

from apnc_plant.coordinates import BASE
from apnc_plant.ground.surface import Surface
from apnc_plant.robot.model import Array, RobotDescription
from exudyn_models.physics import forces
from exudyn_models.physics.touching import touch_of

HOLD_GAINS = (5000.0, 200.0, 50.0, 2.0)
"""Suspension of a held trunk: position [N/m], [N s/m], rotation [N m/rad], [N m s/rad].

Close to critically damped for a robot of some kilograms, and stiff enough that legs swinging in
the air move it by tenths of a millimetre.
"""


def leg_geometry(robot: RobotDescription) -> Array:
    """Geometry of the legs as ``forces.leg_points`` takes it, shape (n_legs, 10)."""
    return np.array(
        [
            (
                *leg.mount,
                *leg.outward(leg.hip_offset),
                leg.femur_length,
                leg.tibia_length,
                leg.femur_angle,
                leg.tibia_angle,
            )
            for leg in robot.legs
        ]
    )


class RobotForces:
    """What acts on the robot besides gravity: called by the engine once per step, by the
    plant once per tick.

    Attributes:
        target: commanded tree coordinates of the joints [rad], shape (3 n_legs,); written by the
            plant.
        step: length of the integration step [s], see :meth:`set_step`.
        foot_mass: apparent mass of a foot along the ground [kg]; written by the plant.
        work: what every servo did since the start, |torque times speed| over time [J], shape
            (3 n_legs,).
        geometry: of the legs, see :func:`leg_geometry`.
        torque, foot, force, load: what :meth:`measure` found: servo torques in tree coordinates
            [N m], foot centres [m], forces on the feet [N] (both world frame, flat) and sums of
            the normal forces [N].
    """

    def __init__(self, robot: RobotDescription, ground: Surface, target: Array) -> None:
        """Bind the forces to a robot on a ground.

        Args:
            robot: geometry, servo and contact.
            ground: the ground.
            target: initial commanded tree coordinates of the joints [rad], shape (3 n_legs,).
        """
        servo, contact = robot.servo, robot.contact
        n = len(robot.legs)
        self.target = target.copy()
        self.step, self.foot_mass = 0.0, math.inf
        self.work = np.zeros(3 * n)
        parameters = np.zeros(forces.PARAMETERS)
        parameters[forces.SERVO : forces.CONTACT] = (
            servo.stiffness,
            servo.damping,
            servo.stall_torque,
            servo.no_load_speed,
        )
        parameters[forces.CONTACT : forces.HOLD] = (
            contact.foot_radius,
            contact.stiffness,
            contact.damping,
            contact.damping_depth,
            contact.friction,
            contact.friction_speed,
            0.0,
        )
        parameters[forces.HOLD + 1 : forces.HOLD + 5] = HOLD_GAINS
        parameters[forces.GROUND : forces.TOP] = ground.rotation().ravel()
        parameters[forces.TOP] = ground.top
        self._stopping = parameters[forces.HOLD - 1 : forces.HOLD]
        self._hold = parameters[forces.HOLD : forces.GROUND]
        self.geometry = leg_geometry(robot)
        numbers = ground.numbers(contact.foot_radius)
        self._ground = (
            parameters,
            touch_of(type(ground)).address,
            np.ascontiguousarray(numbers.reals, np.float64),
            np.ascontiguousarray(numbers.integers, np.int64),
            np.zeros((numbers.contacts, 4)),
        )
        self._corners = robot.trunk.corners()
        size = BASE + 3 * n
        # Three times as fast as making arrays of the lists, at every step.
        both = np.zeros(2 * size)
        self._pack, self._both = struct.Struct(f"{2 * size}d").pack_into, both.data
        self._q, self._v = np.split(both, 2)
        self._generalized = np.zeros(size + 10 * n)
        self._acting = self._generalized[:size]
        self._measured = np.zeros(size + 10 * n)
        self.result = self._measured[size:]
        self.torque, self.foot, self.force, self.load = np.split(self.result, [3 * n, 6 * n, 9 * n])

    def set_step(self, step: float) -> None:
        """Integrate with another step [s] from now on."""
        self.step, self._stopping[0] = step, step / self.foot_mass

    def hold(self, pose: Array | None) -> None:
        """Hold the base at a pose (its six coordinates), or let it go."""
        self._hold[0] = pose is not None
        if pose is not None:
            self._hold[5:] = pose

    def __call__(
        self, mbs: Any, t: float, item: int, q: list[float], v: list[float]
    ) -> list[float]:
        """Generalized forces, as Exudyn asks for them."""
        self._pack(self._both, 0, *q, *v)
        generalized: list[float] = self.acting(self._q, self._v).tolist()
        return generalized

    def acting(self, q: Array, v: Array) -> Array:
        """Generalized forces at the start of an integration step, shape (6 + 3 n_legs,).

        Pitfall: the work of the servos during the step is added, so ask once per step; the array
        is written anew at the next call.
        """
        forces.evaluate(
            q,
            v,
            self.target,
            self.geometry,
            *self._ground,
            self.step,
            self.work,
            self._generalized,
        )
        return self._acting

    def measure(self, q: Array, v: Array) -> None:
        """Evaluate at coordinates and speeds of the tree and keep the result."""
        forces.evaluate(
            q, v, self.target, self.geometry, *self._ground, 0.0, self.work, self._measured
        )

    def fallen(self, q: Array) -> bool:
        """Whether the robot has fallen, at coordinates of the tree, see :func:`forces.fallen`."""
        return forces.fallen(q, self._corners, *self._ground)
