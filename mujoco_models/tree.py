"""The robot as a MuJoCo model in the coordinates of our tree."""

from __future__ import annotations

from typing import Any, ClassVar, Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.legged import Engine, Setup
from apnc_plant.robot.model import RobotDescription
from apnc_plant.robot.names import plainly_named
from apnc_plant.signals import PlantError
from mujoco_models.engine import mj
from mujoco_models.mjcf import foot_of, robot_mjcf, tree_mjcf

WILD: Final = 1e4
"""Norm of the speeds [m/s, rad/s] above which the motion has diverged."""


def export_mjcf(robot: RobotDescription, *, servo: str = "position") -> str:
    """A robot as MJCF for other programs, see ``mjcf.robot_mjcf``; checked by loading it in MuJoCo.

    Its names become plain ones, see ``apnc_plant.robot.names``.

    Raises:
        ValueError: the servo is unknown.
    """
    robot = plainly_named(robot)
    # the contact depends on the admittance of the feet, which only the compiled model tells
    rough = _model(robot_mjcf(robot, [1.0] * len(robot.legs), servo=servo))
    bodies = [rough.geom_bodyid[rough.geom(foot_of(leg)).id] for leg in robot.legs]
    admittances = [float(rough.body_invweight0[body, 0]) for body in bodies]
    text = robot_mjcf(robot, admittances, servo=servo)
    _model(text)
    return text


def _model(text: str) -> Any:
    return mj().MjModel.from_xml_string(text)


class MujocoTree(Engine):
    """The robot in MuJoCo, integrated by velocity Verlet as in Exudyn.

    Servos, suspension and contact are generalized forces from outside, the same as in Exudyn.

    Attributes:
        model, data: MuJoCo's.
    """

    name: ClassVar[str] = "mujoco"

    def __init__(self, setup: Setup) -> None:
        """Compile the model; see ``Engine``."""
        self._forces = setup.forces
        try:
            self.model = _model(tree_mjcf(setup.robot, setup.trunk))
        except ValueError as error:
            raise PlantError(f"MuJoCo refused the model: {' '.join(str(error).split())}") from None
        self.model.opt.gravity[2] = -setup.options.gravity
        self.data = mj().MjData(self.model)
        self.data.qpos[:] = setup.start
        self._accelerate()

    def advance(self, end: float, steps: int, q: Array, v: Array) -> bool:
        """Integrate; see ``Engine``."""
        data, step = self.data, self._forces.step
        position, speed, acceleration = data.qpos, data.qvel, data.qacc
        self.model.opt.timestep = step
        for _ in range(steps):
            speed += 0.5 * step * acceleration
            position += step * speed
            self._accelerate()
            speed += 0.5 * step * acceleration
            if not speed @ speed < WILD**2:  # also if it is not a number
                return False
        data.time = end
        q[:], v[:] = position, speed
        return True

    def _accelerate(self) -> None:
        """Compute the accelerations from the forces at the present coordinates and speeds."""
        self.data.qfrc_applied[:] = self._forces.acting(self.data.qpos, self.data.qvel)
        # mj_step would also check for divergence, and reset the motion with a warning
        mj().mj_forward(self.model, self.data)

    def set_speeds(self, v: Array) -> None:
        """Replace the speeds; see ``Engine``."""
        self.data.qvel[:] = v

    def mass_matrix(self) -> Array:
        """Mass matrix; see ``Engine``."""
        columns = np.zeros((self.model.nv, self.model.nv))
        for column, unit in zip(columns, np.eye(self.model.nv), strict=True):
            mj().mj_mulM(self.model, self.data, column, unit)
        return columns
