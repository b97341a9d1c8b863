"""The plant in any engine: a legged robot on the ground, stepped by control ticks."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import ClassVar, Final, Protocol

import numpy as np

from apnc_core.types import Array
from apnc_plant.chance import checked_seed, side_offset
from apnc_plant.compiled import foot_mass
from apnc_plant.conditions import Conditions
from apnc_plant.coordinates import BASE, Joints
from apnc_plant.forces import RobotForces
from apnc_plant.ground import Ground, GroundInC, Plane
from apnc_plant.numbers import robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot.body import MassProperties
from apnc_plant.robot.model import RobotDescription
from apnc_plant.sensor.load import LoadSensor
from apnc_plant.signals import PlantError, diverged
from apnc_plant.start import start_coordinates
from apnc_plant.step import checked_step, stable_step
from apnc_plant.trace import Trace

NOW: Final = 1e-6
"""Part of a tick within which two moments count as one."""


@dataclass(frozen=True)
class Setup:
    """Everything that an engine needs to build the equations of motion.

    Args:
        robot: the robot.
        trunk: mass properties of its trunk with the payload.
        ground: the ground.
        options: start and gravity.
        step: longest integration step [s].
        start: initial coordinates, shape (6 + 3 n_legs,), see ``coordinates``.
        forces: all forces but gravity.
    """

    robot: RobotDescription
    trunk: MassProperties
    ground: Ground
    options: PlantOptions
    step: float
    start: Array
    forces: RobotForces


class Engine(Protocol):
    """The equations of motion of one robot, which starts at rest, and their integrator."""

    name: ClassVar[str]

    def __init__(self, setup: Setup) -> None:
        """Build the equations of motion.

        Raises:
            PlantError: the engine refused the model.
        """

    def advance(self, end: float, steps: int, q: Array, v: Array) -> bool:
        """Integrate in equal steps, whose length the forces have already.

        Args:
            end: time to integrate to [s].
            steps: number of steps.
            q, v: arrays for the resulting coordinates and speeds, shape (6 + 3 n_legs,).

        Returns:
            False if the motion diverged.
        """

    def set_speeds(self, v: Array) -> None:
        """Replace the present speeds, shape (6 + 3 n_legs,)."""

    def mass_matrix(self) -> Array:
        """Mass matrix at the present coordinates, shape (6 + 3 n_legs, 6 + 3 n_legs)."""


class LeggedPlant:
    """One robot in an engine.

    At the start the robot is at rest and parallel to the ground, with its feet just above it. The
    same robot, seed, ground, conditions and commands give the same motion bit for bit.

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
        ground: Ground | None = None,
        conditions: Conditions | None = None,
    ) -> None:
        """Put the robot on the ground.

        Args:
            robot: the robot.
            seed: chooses the sideways error of the centre of mass and the sensor noise,
                0 to 2^64 - 1.
            options: start and integration.
            ground: the ground; level and smooth if omitted.
            conditions: payload, damage and broken sensors; none if omitted.

        Raises:
            ValueError: conditions name a leg the robot does not have, the seed or step is not
                allowed, or the ground does not take feet of this radius.
            PlantError: the engine refused the model.
        """
        self._robot, self._options = robot, options or PlantOptions()
        self._step = checked_step(self._options.step, robot)
        self._ground = ground or Plane()
        self._conditions = conditions or Conditions()
        self.legs = tuple(leg.name for leg in robot.legs)
        self.n_legs = len(self.legs)
        self.mass = robot.mass + self._conditions.payload
        self.time = 0.0
        self._seed = checked_seed(seed)
        self._sensor = LoadSensor(robot.sensor, self.legs, robot.weight, self._seed)
        self._reading, self._joints = np.zeros(self.n_legs), Joints(robot)
        self._build()
        self.set_conditions(self._conditions)

    def _build(self) -> None:
        options, robot = self._options, self._robot
        offset, payload = side_offset(robot, self._seed), self._conditions.payload
        numbers = robot_numbers(robot, side_offset=offset, payload=payload, gravity=options.gravity)
        ground = GroundInC(self._ground, max(robot.foot_radii))
        self._start = start_coordinates(numbers, ground, options)
        self._commanded = self._start[BASE:].reshape(-1, 3).copy()
        self._coming: deque[tuple[float, Array]] | None = None
        coordinates = self._start.copy()
        coordinates[2] += self._conditions.held_at or 0.0
        coordinates[BASE:] = self._joints.in_tree(coordinates[BASE:].reshape(-1, 3)).ravel()
        self._forces = RobotForces(robot, self._ground, coordinates[BASE:])
        self._forces.foot_mass = foot_mass(robot, numbers, ground, self._start)
        trunk = robot.trunk.loaded(offset, payload)
        setup = Setup(robot, trunk, self._ground, options, self._step, coordinates, self._forces)
        self._engine = self.engine(setup)
        self._q, self._v = coordinates.copy(), np.zeros_like(coordinates)
        self._measure()

    def set_conditions(self, conditions: Conditions) -> None:
        """Set the conditions that hold from now on.

        Raises:
            ValueError: a leg is unknown, or the payload is not the one the plant was built with.
        """
        conditions = conditions.of_legs(self.legs)
        conditions.check_payload(self._conditions.payload)
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
        if self._coming is None:
            self._coming = self._before_the_start(duration)
        self._commanded = targets
        self._coming.append((self._robot.servo.latency, self._joints.in_tree(targets)))
        self._integrate_tick(self._coming, duration)
        self._measure()
        self._forces.check()
        if self._step > stable_step(self._robot) and self.fell:
            raise PlantError(diverged(self.time, self._step))
        load = self._felt_load()
        self._reading[:] = self._sensor.update(load, duration)

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

    def _before_the_start(self, Ts: float) -> deque[tuple[float, Array]]:
        """Delayed commands at the start: before it, the start pose was commanded once per tick.

        With them the first ticks, too, are divided at the moments at which commands arrive.
        """
        ages = range(math.ceil(self._robot.servo.latency / Ts * (1.0 - NOW)) - 1, 0, -1)
        pose = self._joints.in_tree(self._commanded)
        return deque((self._robot.servo.latency - age * Ts, pose) for age in ages)

    def _integrate_tick(self, coming: deque[tuple[float, Array]], duration: float) -> None:
        """Integrate a tick; the commands whose latency has passed reach the servos.

        Args:
            coming: delayed commands, each with the time until it arrives [s].
            duration: length of the tick [s].
        """
        start, done = self.time, 0.0
        while coming and coming[0][0] < duration * (1.0 - NOW):
            wait, targets = coming.popleft()
            if wait > done + NOW * duration:
                self._integrate(start + wait, wait - done)
                done = wait
            self._forces.target[:] = targets.ravel()
        self._integrate(start + duration, duration - done)
        for _ in range(len(coming)):
            wait, targets = coming.popleft()
            coming.append((wait - duration, targets))

    def _integrate(self, end: float, duration: float) -> None:
        steps = max(1, math.ceil(duration / self._step - NOW))
        self._forces.set_step(duration / steps)
        self.time = end
        moved = self._engine.advance(end, steps, self._q, self._v)
        if not moved or not np.isfinite(self._q).all():
            self._forces.check()
            raise PlantError(diverged(self.time, self._step))

    def shift_velocity(self, x: float, y: float) -> None:
        """Change the velocity of the whole robot along x and y of the world at once [m/s]."""
        self._v[:2] += x, y
        self._engine.set_speeds(self._v)

    def _measure(self) -> None:
        self._forces.measure(self._q, self._v)

    def trace(self) -> Trace:
        """A recorder of every signal in ``PLANT_SIGNALS``, with one sample per tick."""
        return Trace(self._parts, self._signals)

    def sample(self) -> dict[str, Array]:
        """One sample of every signal in ``PLANT_SIGNALS``, at the current time."""
        signals = self._signals(np.concatenate(self._parts)[np.newaxis])
        return {name: values[0] for name, values in signals.items()}

    @property
    def _parts(self) -> tuple[Array, ...]:
        return (self._q, self._v, self._forces.result, self._forces.work, self._reading)

    def _signals(self, samples: Array) -> dict[str, Array]:
        n, size = self.n_legs, BASE + 3 * self.n_legs
        ends = np.cumsum([size, size, 3 * n, 3 * n, 3 * n, n, 3 * n])
        q, v, torque, foot, force, _, work, reading = np.split(samples, ends, axis=1)

        def per_leg(values: Array) -> Array:
            return values.reshape(-1, n, 3)

        return {
            "position": q[:, :3].copy(),
            "rpy": q[:, [5, 4, 3]],
            "velocity": v[:, :3].copy(),
            "joint_angle": self._joints.angles(per_leg(q[:, BASE:])),
            "joint_speed": self._joints.angles(per_leg(v[:, BASE:])),
            "joint_torque": self._joints.angles(per_leg(torque)),
            "joint_work": self._joints.by_angle(per_leg(work)),
            "foot_position": per_leg(foot.copy()),
            "foot_force": per_leg(force.copy()),
            "grf": reading.copy(),
        }

    @property
    def fell(self) -> bool:
        """Whether the trunk is tipped by more than 60 degrees or touches the ground with a corner.

        The tilt is measured against the normal of the ground.
        """
        fallen = self._forces.fallen(self._q)
        self._forces.check()
        return fallen
