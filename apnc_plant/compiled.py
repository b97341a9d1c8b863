"""The plant in plain C: everything from command to load is computed by one compiled library."""

from __future__ import annotations

import math
from typing import ClassVar, Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.chance import checked_seed, side_offset
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Ground, GroundInC, Plane
from apnc_plant.library import aligned_memory, library
from apnc_plant.numbers import Numbers, conditions_numbers, robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot.model import RobotDescription
from apnc_plant.sample import sample_signals
from apnc_plant.signals import PlantError, diverged
from apnc_plant.start import start_coordinates
from apnc_plant.step import checked_step
from apnc_plant.trace import Trace

KINDS: Final = {"legs": "PLANT_LEGS", "scalar": "PLANT_SCALAR"}
"""Ways to compute one robot, and their names in ``plant.h``. All give the same bits."""

SHORTEST: Final = 1e-4
"""Shortest control tick [s] for which no delayed command or load is lost."""


class CompiledPlant:
    """One robot in plain C.

    At the start the robot is at rest and parallel to the ground, with its feet just above it. The
    same robot, seed, ground, conditions and commands give the same motion bit for bit on every
    machine.

    Attributes:
        n_legs: number of legs.
        legs: their names.
        mass: total mass with payload [kg].
        time: simulated time [s].
    """

    name: ClassVar[str] = "compiled"

    def __init__(
        self,
        robot: RobotDescription,
        seed: int = 0,
        *,
        options: PlantOptions | None = None,
        ground: Ground | None = None,
        conditions: Conditions | None = None,
        kind: str = "legs",
    ) -> None:
        """Put the robot on the ground.

        Args:
            robot: the robot.
            seed: chooses the sideways error of the centre of mass and the sensor noise,
                0 to 2^64 - 1.
            options: start and integration.
            ground: the ground; level and smooth if omitted.
            conditions: payload, damage and broken sensors; none if omitted.
            kind: ``legs`` computes the legs side by side, which is faster; ``scalar`` one by one.

        Raises:
            ValueError: conditions name a leg the robot does not have, the seed, kind or step is not
                allowed, or the ground does not take feet of this radius.
        """
        ffi, self._lib = library()
        self._seed = checked_seed(seed)
        self._robot, self._options = robot, options or PlantOptions()
        self._step = checked_step(self._options.step, robot)
        self._conditions = conditions or Conditions()
        self.legs = tuple(leg.name for leg in robot.legs)
        self.n_legs = len(self.legs)
        self.mass = robot.mass + self._conditions.payload
        self.time = 0.0
        ground = ground or Plane()
        self._ground = GroundInC(ground, max(robot.foot_radii))
        self._grounds = ffi.new("plant_ground *[1]", [self._ground.at])
        self._numbers = robot_numbers(
            robot,
            side_offset=side_offset(robot, self._seed),
            payload=self._conditions.payload,
            gravity=self._options.gravity,
        )
        self._start = start_coordinates(self._numbers, self._ground, self._options)
        self._plant = PlantInC(robot, self._ground, kind)
        self._theta = np.zeros((2, self.n_legs))
        self._hip, self._knee = (ffi.from_buffer("double[]", angles) for angles in self._theta)
        self._latest = np.zeros(self._lib.plant_sample_size(self.n_legs))
        self._sample_in_c = ffi.from_buffer("double[]", self._latest)
        self._height, self._ticking = self._conditions.held_at or 0.0, 0.0
        self._place(1.0 / 60.0)
        self.set_conditions(self._conditions)

    def _place(self, Ts: float) -> None:
        """Put the robot to its start; before it, commands came at a distance of Ts [s]."""
        self._ticking = Ts
        self._plant.place(self._numbers, self._seed, self._start, self._height, Ts)
        self._measure()

    def set_conditions(self, conditions: Conditions) -> None:
        """Set the conditions that hold from now on.

        Raises:
            ValueError: a leg is unknown, or the payload is not the one the plant was built with.
        """
        conditions = conditions.of_legs(self.legs)
        conditions.check_payload(self._conditions.payload)
        self._conditions = conditions
        numbers = conditions_numbers(conditions, self.legs, self._robot.weight)
        self._lib.plant_set_conditions(self._plant.at, 0, numbers.at)

    def grf(self) -> Array:
        """Load of each foot as the sensors deliver it since the last tick [N], shape (n_legs,)."""
        return self._latest[-self.n_legs :].copy()

    def advance(self, theta_hip: Array, theta_knee: Array, duration: float) -> None:
        """Command the servos and integrate one control tick.

        Args:
            theta_hip, theta_knee: joint targets relative to the reference pose [rad], shape
                (n_legs,); positive swings the leg forward and lifts the foot.
            duration: length of the tick [s].

        Raises:
            ValueError: a target is not finite or has the wrong shape, the duration is not
                positive, or the touch function of a ground of one's own raised an error.
            PlantError: the integration diverged.
        """
        for angles, name, value in zip(
            self._theta, ("theta_hip", "theta_knee"), (theta_hip, theta_knee), strict=True
        ):
            if np.shape(value) != (self.n_legs,) or not np.isfinite(value).all():
                raise ValueError(f"{name} is {value}; allowed: {self.n_legs} finite angles")
            angles[:] = value
        if not (math.isfinite(duration) and duration > 0.0):
            raise ValueError(f"duration is {duration}; allowed: a finite number above 0")
        if self.time == 0.0 and duration != self._ticking:
            self._place(duration)
            self.set_conditions(self._conditions)
        self._lib.plant_command(self._plant.at, 0, self._hip, self._knee)
        self._lib.plant_advance(self._plant.at, self._grounds, duration, self._step)
        self.time += duration
        self._ground.check()
        self._measure()
        if self._lib.plant_state_of(self._plant.at, 0) == self._lib.PLANT_DIVERGED:
            raise PlantError(diverged(self.time, self._step))

    def shift_velocity(self, x: float, y: float) -> None:
        """Change the velocity of the whole robot along x and y of the world at once [m/s]."""
        self._lib.plant_shift_velocity(self._plant.at, 0, x, y)

    def _measure(self) -> None:
        self._lib.plant_sample(self._plant.at, 0, self._sample_in_c)

    def trace(self) -> Trace:
        """A recorder of every signal in ``PLANT_SIGNALS``, with one sample per tick."""
        return Trace((self._latest,), self._signals)

    def sample(self) -> dict[str, Array]:
        """One sample of every signal in ``PLANT_SIGNALS``, at the current time."""
        signals = self._signals(self._latest[np.newaxis])
        return {name: values[0] for name, values in signals.items()}

    def _signals(self, samples: Array) -> dict[str, Array]:
        return sample_signals(samples, self.n_legs)

    @property
    def fell(self) -> bool:
        """Whether the trunk is tipped by more than 60 degrees or touches the ground with a corner.

        The tilt is measured against the normal of the ground.
        """
        return bool(self._lib.plant_state_of(self._plant.at, 0) == self._lib.PLANT_FELL)


class PlantInC:
    """Memory of a plant for one robot; see ``plant.h``.

    Attributes:
        at: pointer to the memory.
    """

    def __init__(self, robot: RobotDescription, ground: GroundInC, kind: str) -> None:
        """Allocate the memory.

        Args:
            robot: the robot that will be placed.
            ground: the ground that it will stand on.
            kind: way to compute it, see ``KINDS``.

        Raises:
            ValueError: the kind is unknown.
        """
        if kind not in KINDS:
            raise ValueError(f"kind '{kind}' is not one of {', '.join(KINDS)}")
        _, self._lib = library()
        self._ground = ground
        history = self._lib.plant_history(robot.servo.latency, robot.sensor.delay, SHORTEST)
        contacts = 0 if ground.flat else ground.contacts
        how = getattr(self._lib, KINDS[kind]), self._lib.plant_best_level()
        self._room = (*how, len(robot.legs), contacts, history)
        self.at, self._owner = aligned_memory(self._lib.plant_size(*self._room))

    def place(
        self, robot: Numbers, seed: int, coordinates: Array, height: float, Ts: float
    ) -> None:
        """Put the robot to its start.

        Args:
            robot: the robot.
            seed: seed of the sensors' noise.
            coordinates: start coordinates, see ``start_coordinates``.
            height: height by which the trunk starts above them [m].
            Ts: distance of the commands before the start [s].
        """
        ffi, _ = library()
        start = ffi.from_buffer("double[]", np.ascontiguousarray(coordinates))
        self._lib.plant_create(self.at, *self._room)
        self._lib.plant_place(self.at, 0, robot.at, self._ground.at, seed, start, height, Ts)


def foot_mass(
    robot: RobotDescription, numbers: Numbers, ground: GroundInC, coordinates: Array
) -> float:
    """Least apparent mass of any foot in any direction along the ground at the start [kg].

    It is the force over the acceleration of a foot that is pushed sideways while the other feet are
    free: 1 / the largest eigenvalue of T' J M^-1 J' T, with J the Jacobian of the centre of the
    foot, T two unit vectors along the ground and M the mass matrix (Khatib, 1987).

    Args:
        robot: the robot.
        numbers: numbers of the robot, with payload and side offset.
        ground: the ground.
        coordinates: start coordinates, see ``start_coordinates``.
    """
    _, lib = library()
    plant = PlantInC(robot, ground, "scalar")
    plant.place(numbers, 0, coordinates, 0.0, 1.0)
    return float(lib.plant_foot_mass(plant.at, 0))
