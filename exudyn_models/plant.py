"""A legged robot on the ground, stepped from one control tick to the next."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from exudyn_models.description import GRAVITY, Array, RobotDescription
from exudyn_models.engine import exu
from exudyn_models.ground import add_ground, foot_forces
from exudyn_models.kinematics import Kinematics, LegState, rotation_rpy
from exudyn_models.sensor import LoadSensor
from exudyn_models.servo import add_servos, servo_torque
from exudyn_models.tree import BASE, JOINT_SIGN, add_tree

TIPPED_OVER: Final = math.radians(60.0)


class PlantError(RuntimeError):
    """The integration broke down."""


@dataclass(frozen=True)
class PlantOptions:
    """How a plant is started and integrated.

    Args:
        step: longest integration step [s]; a tick is cut into equal steps of at most this.
        gravity: downward acceleration [m/s^2].
        clearance: height of the lowest foot above the ground at the start [m].
        start_hip, start_knee: joint angles of every leg at the start, relative to the reference
            pose [rad].
    """

    step: float = 5e-4
    gravity: float = GRAVITY
    clearance: float = 0.0
    start_hip: float = 0.0
    start_knee: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a step that is not positive and values that are not finite."""
        if not (math.isfinite(self.step) and self.step > 0.0):
            raise ValueError(f"step is {self.step}; allowed: a finite number above 0")
        for name in ("gravity", "clearance", "start_hip", "start_knee"):
            value = getattr(self, name)
            if not math.isfinite(value):
                raise ValueError(f"{name} is {value}; allowed: a finite number")


@dataclass(frozen=True)
class _State:
    """Everything measured at one instant: computed once per tick, read by several methods.

    Args:
        coordinates, speeds: of the tree, shape (6 + 3 n_legs,).
        joints, joint_speeds: in the sense of the controller, shape (n_legs, 3).
        trunk: rotation from trunk to world, shape (3, 3).
        legs: feet and joint axes in the trunk frame.
        foot_force: force of the ground on the feet, world frame [N], shape (n_legs, 3).
    """

    coordinates: Array
    speeds: Array
    joints: Array
    joint_speeds: Array
    trunk: Array
    legs: LegState
    foot_force: Array


class Plant:
    """One robot in its own Exudyn system.

    It stands upright with level trunk and feet just above the ground, at rest. The same robot,
    seed and commands give the same motion bit for bit.

    Attributes:
        n_legs: number of legs.
        legs: their names.
        mass: total mass [kg].
        time: simulated time [s].
    """

    def __init__(
        self, robot: RobotDescription, seed: int = 0, *, options: PlantOptions | None = None
    ) -> None:
        """Put the robot on the ground.

        Args:
            robot: the robot.
            seed: chooses the sideways error of the centre of mass and the sensor noise.
            options: start and integration.
        """
        self._robot, self._options = robot, options or PlantOptions()
        self.legs = tuple(leg.name for leg in robot.legs)
        self.n_legs = len(self.legs)
        self.mass = robot.mass
        self.time = 0.0
        body_seed, noise_seed = np.random.SeedSequence(seed).spawn(2)
        self._sensor = LoadSensor(
            robot.sensor, self.n_legs, robot.weight, np.random.default_rng(noise_seed)
        )
        self._reading = np.zeros(self.n_legs)
        self._kinematics = Kinematics(robot)
        self._corners = robot.trunk.corners()
        self._build(_side_offset(robot, np.random.default_rng(body_seed)))

    def _build(self, side_offset: float) -> None:
        options = self._options
        start = self._start_coordinates()
        self._targets = start[BASE:]
        # The container owns the system: without this reference Exudyn frees it under our feet.
        self._container = exu.SystemContainer()
        self._mbs: Any = self._container.AddSystem()
        self._tree = add_tree(self._mbs, self._robot, side_offset, options.gravity, start)
        self._servos = add_servos(self._mbs, self._tree, self._robot.servo, self._targets)
        self._contacts = add_ground(self._mbs, self._tree, self._robot.contact)
        self._mbs.Assemble()
        self._settings = _solver_settings(options.step)
        self._solver: Any = exu.MainSolverExplicit()
        if not self._solver.InitializeSolver(self._mbs, self._settings):
            raise PlantError("Exudyn refused the model")
        self._state = self._measure()

    def _start_coordinates(self) -> Array:
        angles = np.tile([0.0, self._options.start_hip, self._options.start_knee], (self.n_legs, 1))
        lowest_foot = self._kinematics.legs(angles).foot[:, 2].min()
        height = self._options.clearance + self._robot.contact.foot_radius - lowest_foot
        base = np.array([0.0, 0.0, height, 0.0, 0.0, 0.0])
        return np.concatenate([base, (angles * JOINT_SIGN).ravel()])

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
        self._targets = (targets * JOINT_SIGN).ravel()
        self._servos.command(self._mbs, self._targets)
        self._integrate(duration)
        self._state = self._measure()
        self._reading = self._sensor.update(self.time, self._state.foot_force[:, 2], duration)

    def _checked_targets(self, theta_hip: Array, theta_knee: Array) -> Array:
        for name, value in (("theta_hip", theta_hip), ("theta_knee", theta_knee)):
            if np.shape(value) != (self.n_legs,) or not np.isfinite(value).all():
                raise ValueError(f"{name} is {value}; allowed: {self.n_legs} finite angles")
        return np.stack([np.zeros(self.n_legs), theta_hip, theta_knee], axis=1)

    def _integrate(self, duration: float) -> None:
        self.time += duration
        steps = max(1, math.ceil(duration / self._options.step - 1e-9))
        iteration = self._solver.it
        iteration.maxStepSize = iteration.currentStepSize = duration / steps
        iteration.endTime = self.time
        solved = self._solver.SolveSteps(self._mbs, self._settings)
        if not solved or not np.isfinite(self._mbs.systemData.GetODE2Coordinates()).all():
            raise PlantError(f"the motion diverged before t = {self.time:.4f} s")

    def _measure(self) -> _State:
        q = np.array(self._mbs.systemData.GetODE2Coordinates())
        speeds = np.array(self._mbs.systemData.GetODE2Coordinates_t())
        joints = q[BASE:].reshape(-1, 3) * JOINT_SIGN
        joint_speeds = speeds[BASE:].reshape(-1, 3) * JOINT_SIGN
        trunk = rotation_rpy(q[5], q[4], q[3])
        legs = self._kinematics.legs(joints)
        force = foot_forces(self._contacts, legs, trunk, self._robot.contact.foot_radius)
        return _State(q, speeds, joints, joint_speeds, trunk, legs, force)

    def sample(self) -> dict[str, Array]:
        """One sample of every channel in ``recording.PLANT_CHANNELS``, at the current time."""
        state = self._state
        q = state.coordinates
        target = self._targets.reshape(-1, 3) * JOINT_SIGN
        torque = servo_torque(self._robot.servo, target, state.joints, state.joint_speeds)
        return {
            "position": q[:3].copy(),
            "rpy": q[[5, 4, 3]],
            "velocity": state.speeds[:3].copy(),
            "joint_angle": state.joints.copy(),
            "joint_speed": state.joint_speeds.copy(),
            "joint_torque": torque,
            "foot_position": q[:3] + state.legs.foot @ state.trunk.T,
            "foot_force": state.foot_force.copy(),
            "grf": self.grf(),
        }

    @property
    def fell(self) -> bool:
        """Whether roll or pitch exceeds 60 degrees or a corner of the trunk touches the ground."""
        height, pitch, roll = self._state.coordinates[[2, 4, 5]]
        lowest = height + (self._corners @ self._state.trunk[2]).min()
        return bool(max(abs(roll), abs(pitch)) > TIPPED_OVER or lowest <= 0.0)


def _side_offset(robot: RobotDescription, random: np.random.Generator) -> float:
    side = random.choice([-1.0, 1.0])
    return float(side * robot.trunk.com_side_offset * random.uniform(0.75, 1.25))


def _solver_settings(step: float) -> Any:
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.solverType = exu.DynamicSolverType.ExplicitEuler
    integration.numberOfSteps = 1
    integration.endTime = step
    integration.verboseMode = 0
    integration.explicit.useLieGroupIntegration = False
    # Exudyn would evaluate the equations a second time per step, for accelerations nobody reads.
    integration.explicit.computeEndOfStepAccelerations = False
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.solution.file.write = False
    settings.solution.sensors.active = False
    return settings
