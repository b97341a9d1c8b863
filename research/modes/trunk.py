"""The reduced plant: a rigid trunk on massless compliant legs that only push."""

from __future__ import annotations

import numpy as np

from apnc_core.types import Array
from apnc_plant.chance import side_offset
from apnc_plant.conditions import Conditions
from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription
from apnc_plant.sensor.load import LoadSensor
from apnc_plant.trace import Trace
from research.modes.stance import stance_of


class SpringTrunk:
    """A plant with three degrees of freedom: height, pitch and roll of the trunk.

    A foot on the ground pushes with F = k (L - h) - d dh/dt and never pulls. L is the length of the
    leg at the joint commands, h the height of the hip over the foot, and d = k D/P. In the air a
    leg follows its command with the lag D/P. The feet stay below their place in the reference pose:
    motion along the ground is left out.

    Attributes:
        legs, mass, fell: as every plant.
        load: vertical force on each foot [N], shape (n,).
    """

    fell = False

    def __init__(self, robot: RobotDescription, seed: int = 0, substeps: int = 4) -> None:
        """Stand at rest on all legs.

        Args:
            robot: the robot.
            seed: chooses the sideways error of the centre of mass and the sensor noise,
                0 to 2^64 - 1.
            substeps: implicit Euler steps per control tick.
        """
        self.legs, self.mass = tuple(leg.name for leg in robot.legs), robot.mass
        self._stance = stance_of(robot, side_offset(robot, seed))
        self._sensor = LoadSensor(robot.sensor, self.legs, robot.weight, seed)
        self._kinematics, self._substeps = Kinematics(robot), substeps
        trunk = robot.trunk.inertia_tensor().diagonal()[[1, 0]]
        hung = sum(leg.mass * np.square(leg.mount[:2]) for leg in robot.legs)
        self._inertia = np.diag([robot.mass, *(trunk + hung)])
        still = np.zeros(len(self.legs))
        self._length = self._wanted(still, still)
        self.load = self._stance.carried(range(len(self.legs)))
        rest = self._length - self.load / self._stance.stiffness
        self._q = np.linalg.lstsq(self._stance.rigid, rest, rcond=None)[0]
        self._v, self._reading = np.zeros(3), still

    def _wanted(self, hip: Array, knee: Array) -> Array:
        return -self._kinematics.feet(np.stack([np.zeros_like(hip), hip, knee], axis=1))[:, 2]

    def grf(self) -> Array:
        """Load of each foot as its sensor shows it now [N], shape (n,)."""
        return self._reading.copy()

    def set_conditions(self, conditions: Conditions) -> None:
        """Change what the sensors deliver; it knows no other condition."""
        self._sensor.disturb(conditions)

    def advance(self, theta_hip: Array, theta_knee: Array, duration: float) -> None:
        """Follow joint commands [rad], shape (n,), for a time [s]."""
        wanted = self._wanted(theta_hip, theta_knee)
        for _ in range(self._substeps):
            self._step(wanted, duration / self._substeps)
        self._reading[:] = self._sensor.update(self.load, duration)

    def _step(self, wanted: Array, dt: float) -> None:
        """One implicit Euler step.

        Legs that would pull are taken off the ground and the step is solved again, once per leg at
        most.
        """
        s, A, k = self._stance, self._stance.rigid, self._stance.stiffness
        self._length += (wanted - self._length) * -np.expm1(-dt / s.lag)
        on = self._length >= A @ (self._q + dt * self._v)
        before = self._inertia @ self._v / dt - np.array([s.weight, 0.0, 0.0])
        short = k * (wanted - A @ self._q)
        drag = k * (s.lag + dt)
        for _ in self.legs:
            M = self._inertia / dt + (A.T * (on * drag)) @ A
            v = np.linalg.solve(M, before + A.T @ (on * short))
            force = on * (short - drag * (A @ v))
            if (force >= 0.0).all():
                break
            on &= force >= 0.0
        self._v, self._q, self.load = v, self._q + dt * v, np.maximum(force, 0.0)
        height = A @ self._q
        self._length = np.where(on, height, np.minimum(self._length, height))

    def trace(self) -> Trace:
        """A recorder of the loads that the sensors show."""
        return Trace((self._reading,), lambda rows: {"grf": rows.copy()})
