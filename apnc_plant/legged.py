"""A legged robot on the ground, stepped from one control tick to the next, in any engine."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from apnc_plant.channels import PlantError
from apnc_plant.conditions import Conditions
from apnc_plant.coordinates import BASE, JOINT_SIGN
from apnc_plant.ground import Plane, Surface
from apnc_plant.options import PlantOptions
from apnc_plant.robot.model import Array, MassProperties, RobotDescription
from apnc_plant.sensor.load import LoadSensor
from apnc_plant.start import start_coordinates
from apnc_plant.trace import Trace
from exudyn_models.physics.apparent_mass import apparent_mass
from exudyn_models.physics.robot_forces import RobotForces


@dataclass(frozen=True)
class Setup:
    """What an engine builds the equations of motion of.

    Args:
        robot: the robot.
        trunk: mass properties of its trunk with what it carries.
        ground: what it stands on.
        options: start and integration.
        start: initial coordinates, shape (6 + 3 n_legs,), see ``coordinates``.
        forces: everything that acts besides gravity.
    """

    robot: RobotDescription
    trunk: MassProperties
    ground: Surface
    options: PlantOptions
    start: Array
    forces: RobotForces


class Engine(Protocol):
    """The equations of motion of one robot at rest in its start, integrated step by step."""

    name: ClassVar[str]

    def __init__(self, setup: Setup) -> None:
        """Build them.

        Raises:
            PlantError: the engine refused the model.
        """

    def advance(self, end: float, steps: int, q: Array, v: Array) -> bool:
        """Integrate in equal steps, whose length the forces know already.

        Args:
            end: time to integrate to [s].
            steps: number of steps.
            q, v: coordinates and speeds, written here, shape (6 + 3 n_legs,).

        Returns:
            Whether it could.
        """

    def mass_matrix(self) -> Array:
        """Mass matrix at the present coordinates, shape (6 + 3 n_legs, 6 + 3 n_legs)."""


class LeggedPlant:
    """One robot in an engine of its own.

    It stands parallel to the ground with its feet just above it, at rest. The same robot, seed,
    ground, conditions and commands give the same motion bit for bit.

    Attributes:
        n_legs: number of legs.
        legs: their names.
        mass: total mass with payload [kg].
        time: simulated time [s].
    """

    engine: ClassVar[type[Engine]]

    def __init__(
        self,
        robot: RobotDescription,
        seed: int = 0,
        *,
        options: PlantOptions | None = None,
        ground: Surface | None = None,
        conditions: Conditions | None = None,
    ) -> None:
        """Put the robot on the ground.

        Args:
            robot: the robot.
            seed: chooses the sideways error of the centre of mass and the sensor noise.
            options: start and integration.
            ground: what it stands on; level and smooth if omitted.
            conditions: payload, damage and the like; none if omitted.

        Raises:
            ValueError: conditions name a leg the robot does not have.
            PlantError: the engine refused the model.
        """
        self._robot, self._options = robot, options or PlantOptions()
        self._ground = ground or Plane()
        self._conditions = conditions or Conditions()
        self.legs = tuple(leg.name for leg in robot.legs)
        self.n_legs = len(self.legs)
        self.mass = robot.mass + self._conditions.payload
        self.time = 0.0
        body_seed, noise_seed = np.random.SeedSequence(seed).spawn(2)
        self._sensor = LoadSensor(
            robot.sensor, self.legs, robot.weight, np.random.default_rng(noise_seed)
        )
        self._reading = np.zeros(self.n_legs)
        self._build(side_offset(robot, np.random.default_rng(body_seed)))
        self.set_conditions(self._conditions)

    def _build(self, side_offset: float) -> None:
        options, robot = self._options, self._robot
        angles = np.array([0.0, options.start_hip, options.start_knee])
        self._start = start_coordinates(robot, self._ground, angles, options.clearance)
        coordinates = self._start.copy()
        coordinates[2] += self._conditions.held_at or 0.0
        self._forces = RobotForces(robot, self._ground, coordinates[BASE:])
        self._commanded = coordinates[BASE:].reshape(-1, 3) * JOINT_SIGN
        self._coming: deque[tuple[float, Array]] = deque()
        trunk = robot.trunk.loaded(side_offset, self._conditions.payload)
        setup = Setup(robot, trunk, self._ground, options, coordinates, self._forces)
        self._engine = self.engine(setup)
        self._q, self._v = coordinates.copy(), np.zeros_like(coordinates)
        self._forces.foot_mass = apparent_mass(
            self._forces, coordinates, self._engine.mass_matrix(), self._ground.rotation()[:, :2]
        )
        self._measure()

    def set_conditions(self, conditions: Conditions) -> None:
        """Change what is wrong with the robot, from now on.

        Raises:
            ValueError: an unknown leg, or another payload than the plant was built with.
        """
        conditions.check_legs(self.legs)
        if conditions.payload != self._conditions.payload:
            raise ValueError(
                f"payload is {conditions.payload} kg; allowed: {self._conditions.payload} kg, "
                "fixed when the plant was built"
            )
        self._conditions = conditions
        self._damaged = [leg in conditions.damaged for leg in self.legs]
        self._sensor.disturb(conditions)
        self._forces.hold(self._held_pose(conditions.held_at))

    def _held_pose(self, height: float | None) -> Array | None:
        if height is None:
            return None
        pose = self._start[:BASE].copy()
        pose[[0, 1, 3]] = self._q[[0, 1, 3]]
        pose[2] += height
        return pose

    def grf(self) -> Array:
        """Load of each foot as the sensors deliver it since the last tick [N], shape (n_legs,)."""
        return self._reading.copy()

    def advance(self, theta_hip: Array, theta_knee: Array, duration: float) -> None:
        """Command the servos and integrate one control tick.

        Args:
            theta_hip, theta_knee: joint targets relative to the reference pose [rad], shape
                (n_legs,); positive swings the leg forward and lifts the foot.
            duration: length of the tick [s].

        Raises:
            ValueError: a target is not finite or has the wrong shape, or the duration is not
                positive.
            PlantError: the integration diverged.
        """
        targets = self._checked_targets(theta_hip, theta_knee)
        if not (math.isfinite(duration) and duration > 0.0):
            raise ValueError(f"duration is {duration}; allowed: a finite number above 0")
        targets[self._damaged] = 0.0
        if self._robot.servo.slew_rate > 0.0:
            reach = self._robot.servo.slew_rate * duration
            targets = np.clip(targets, self._commanded - reach, self._commanded + reach)
        self._commanded = targets
        self._coming.append((self.time + self._robot.servo.latency, targets * JOINT_SIGN))
        self._integrate_to(self.time + duration)
        self._measure()
        load = self._felt_load()
        self._reading[:] = self._sensor.update(self.time, load, duration)

    def _checked_targets(self, theta_hip: Array, theta_knee: Array) -> Array:
        targets = np.zeros((self.n_legs, 3))
        for column, name, value in ((1, "theta_hip", theta_hip), (2, "theta_knee", theta_knee)):
            if np.shape(value) != (self.n_legs,) or not np.isfinite(value).all():
                raise ValueError(f"{name} is {value}; allowed: {self.n_legs} finite angles")
            targets[:, column] = value
        return targets

    def _felt_load(self) -> Array:
        if self._robot.sensor.component == "norm":
            return np.asarray(np.linalg.norm(self._forces.force.reshape(-1, 3), axis=1))
        return self._forces.load.copy()

    def _integrate_to(self, end: float) -> None:
        while self._coming and self._coming[0][0] < end:
            arrival, targets = self._coming.popleft()
            if arrival > self.time:
                self._integrate(arrival)
            self._forces.target[:] = targets.ravel()
        self._integrate(end)

    def _integrate(self, end: float) -> None:
        duration = end - self.time
        steps = max(1, math.ceil(duration / self._options.step - 1e-9))
        self._forces.set_step(duration / steps)
        self.time = end
        moved = self._engine.advance(end, steps, self._q, self._v)
        if not moved or not np.isfinite(self._q).all():
            raise PlantError(f"the motion diverged before t = {self.time:.4f} s")

    def _measure(self) -> None:
        self._forces.measure(self._q, self._v)

    def trace(self) -> Trace:
        """A recorder of every channel in ``PLANT_CHANNELS``, a row per tick."""
        return Trace(self._parts, self._channels)

    def sample(self) -> dict[str, Array]:
        """One sample of every channel in ``PLANT_CHANNELS``, at the current time."""
        channels = self._channels(np.concatenate(self._parts)[np.newaxis])
        return {name: values[0] for name, values in channels.items()}

    @property
    def _parts(self) -> tuple[Array, ...]:
        return (self._q, self._v, self._forces.result, self._forces.work, self._reading)

    def _channels(self, rows: Array) -> dict[str, Array]:
        n, size = self.n_legs, BASE + 3 * self.n_legs
        ends = np.cumsum([size, size, 3 * n, 3 * n, 3 * n, n, 3 * n])
        q, v, torque, foot, force, _, work, reading = np.split(rows, ends, axis=1)

        def per_leg(values: Array) -> Array:
            return values.reshape(-1, n, 3)

        return {
            "position": q[:, :3].copy(),
            "rpy": q[:, [5, 4, 3]],
            "velocity": v[:, :3].copy(),
            "joint_angle": per_leg(q[:, BASE:]) * JOINT_SIGN,
            "joint_speed": per_leg(v[:, BASE:]) * JOINT_SIGN,
            "joint_torque": per_leg(torque) * JOINT_SIGN,
            "joint_work": per_leg(work.copy()),
            "foot_position": per_leg(foot.copy()),
            "foot_force": per_leg(force.copy()),
            "grf": reading.copy(),
        }

    @property
    def fell(self) -> bool:
        """Whether the trunk is tipped by more than 60 degrees or touches the ground with a corner.

        The tilt is measured against the normal of the ground.
        """
        return self._forces.fallen(self._q)


def side_offset(robot: RobotDescription, random: np.random.Generator) -> float:
    """Sideways error of the centre of mass [m]: side and amount by chance."""
    side = random.choice([-1.0, 1.0])
    return float(side * robot.trunk.com_side_offset * random.uniform(0.75, 1.25))
