"""Forces on a robot, computed in C, for engines other than the plant in C."""

from __future__ import annotations

import math
import struct
from typing import Any

import numpy as np

from apnc_core.types import Array
from apnc_plant.coordinates import BASE
from apnc_plant.ground import Ground, GroundInC
from apnc_plant.library import library
from apnc_plant.numbers import robot_numbers
from apnc_plant.robot.model import RobotDescription


class RobotForces:
    """All forces on a robot on a ground but gravity.

    An engine calls them once per integration step, the plant once per tick.

    Attributes:
        target: commanded tree coordinates of the joints [rad], shape (3 n_legs,); written by the
            plant.
        step: length of the integration step [s], see :meth:`set_step`.
        foot_mass: apparent mass of a foot along the ground [kg]; written by the plant.
        work: |torque times speed| of every servo, integrated over time since the start [J], shape
            (3 n_legs,).
        result: flat results of :meth:`measure`: the four attributes below, one after the other.
        torque, foot, force, load: servo torques in tree coordinates [N m], foot centres [m],
            forces on the feet [N] (both world frame, flat) and sums of the normal forces [N].
    """

    def __init__(self, robot: RobotDescription, ground: Ground, target: Array) -> None:
        """Bind the forces to a robot on a ground.

        Args:
            robot: geometry, servo and contact.
            ground: the ground.
            target: initial commanded tree coordinates of the joints [rad], shape (3 n_legs,).

        Raises:
            ValueError: the ground does not take such feet.
        """
        ffi, self._lib = library()
        self._robot = robot_numbers(robot)
        self._ground = GroundInC(ground, max(robot.foot_radii))
        self._unpack = ffi.unpack
        n, size = len(robot.legs), BASE + 3 * len(robot.legs)
        self._size, length = size, size + 10 * n

        def shared(count: int) -> tuple[Array, Any]:
            values = np.zeros(count)
            return values, ffi.from_buffer("double[]", values)

        self.step, self.foot_mass, self._stopping = 0.0, math.inf, 0.0
        self.target, self._target = shared(3 * n)
        self.target[:] = target
        self.work, self._work = shared(3 * n)
        self._pose, self._pose_in_c = shared(BASE)
        self._nobody = self._held = ffi.NULL
        # packing the lists is three times as fast as making arrays of them
        both, self._q_in_c = shared(2 * size)
        self._v_in_c = self._q_in_c + size
        self._pack, self._both = struct.Struct(f"{2 * size}d").pack_into, both.data
        self._q, self._v = np.split(both, 2)
        room = length + 4 * self._ground.contacts
        self._generalized, self._acting_in_c = shared(room)
        self._acting = self._generalized[:size]
        measured, self._measured_in_c = shared(room)
        self._measured = measured[:length]
        self.result = self._measured[size:]
        self.torque, self.foot, self.force, self.load = np.split(self.result, [3 * n, 6 * n, 9 * n])

    def set_step(self, step: float) -> None:
        """Set the length of the integration step from now on [s]."""
        self.step, self._stopping = step, step / self.foot_mass

    def hold(self, pose: Array | None) -> None:
        """Hold the base at a pose, its six coordinates; None releases it."""
        self._held = self._nobody if pose is None else self._pose_in_c
        if pose is not None:
            self._pose[:] = pose

    def __call__(
        self, mbs: Any, t: float, item: int, q: list[float], v: list[float]
    ) -> list[float]:
        """Generalized forces, with the arguments of a user function of Exudyn."""
        self._pack(self._both, 0, *q, *v)
        self._evaluate(self.step, self._acting_in_c)
        # Exudyn takes a list in half the time that it takes an array
        generalized: list[float] = self._unpack(self._acting_in_c, self._size)
        return generalized

    def acting(self, q: Array, v: Array) -> Array:
        """Generalized forces at the start of an integration step, shape (6 + 3 n_legs,).

        Pitfall: a call adds the work of the servos during the step, so call it once per step. The
        next call overwrites the array.
        """
        self._q[:], self._v[:] = q, v
        self._evaluate(self.step, self._acting_in_c)
        return self._acting

    def measure(self, q: Array, v: Array) -> None:
        """Evaluate at coordinates and speeds of the tree and keep the result."""
        self._q[:], self._v[:] = q, v
        self._evaluate(0.0, self._measured_in_c)

    def _evaluate(self, dt: float, out: Any) -> None:
        self._lib.plant_forces(
            self._robot.at,
            self._ground.at,
            self._q_in_c,
            self._v_in_c,
            self._target,
            self._held,
            self._stopping,
            dt,
            self._work,
            out,
        )

    def fallen(self, q: Array) -> bool:
        """Whether the trunk is tipped by more than 60 degrees or touches the ground with a corner.

        The tilt is the angle between the trunk's upright axis and the normal of the ground. On a
        steep slope the trunk may point straight up or down before it is tipped that far. There yaw
        and roll have the same axis, so a fall counts 10 degrees before the trunk points that way.

        Args:
            q: coordinates of the tree; the first six count.
        """
        self._q[:] = q
        found = self._lib.plant_fallen(
            self._robot.at, self._ground.at, self._q_in_c, self._ground.found
        )
        return bool(found)

    def check(self) -> None:
        """Raise an error that occurred in the touch function of a ground of one's own.

        Raises:
            ValueError: the touch function raised an error since the last check.
        """
        self._ground.check()
