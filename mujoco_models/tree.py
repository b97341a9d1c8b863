"""The robot as a MuJoCo model in the coordinates of our tree."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar, Final

import numpy as np

from apnc_plant.channels import PlantError
from apnc_plant.legged import Engine, Setup
from apnc_plant.options import COMPILED
from apnc_plant.robot.model import Array, RobotDescription
from mujoco_models.contact import Pair, pair_of
from mujoco_models.engine import mj
from mujoco_models.mjcf import foot_of, robot_mjcf, tree_mjcf

WILD: Final = 1e4
"""Norm of the speeds [m/s, rad/s] beyond which the motion has broken down."""


def export_mjcf(robot: RobotDescription, *, servo: str = "position") -> str:
    """A robot as MJCF for other users, see ``mjcf.robot_mjcf``; MuJoCo has loaded it.

    Raises:
        ValueError: an unknown servo.
    """
    return _with_contact(robot, lambda pairs: robot_mjcf(robot, pairs, servo=servo))


def _with_contact(robot: RobotDescription, text: Callable[[Sequence[Pair]], str]) -> str:
    """A model whose contact is that of the robot file: its admittance is known once compiled."""
    rough = mj.MjModel.from_xml_string(text([pair_of(robot, 1.0)] * len(robot.legs)))
    names = [foot_of(leg) for leg in robot.legs]
    bodies = [rough.geom_bodyid[rough.geom(name).id] for name in names]
    return text([pair_of(robot, float(rough.body_invweight0[body, 0])) for body in bodies])


class MujocoTree(Engine):
    """The robot in MuJoCo, integrated by velocity Verlet as in Exudyn.

    Servos, suspension and the compiled contact are generalized forces from outside, the very ones
    that Exudyn gets.

    Attributes:
        model, data: MuJoCo's.
    """

    name: ClassVar[str] = "mujoco"

    def __init__(self, setup: Setup) -> None:
        """Compile the model; see ``Engine``."""
        robot, ground, options = setup.robot, setup.ground, setup.options
        own = options.contact != COMPILED
        if own and not ground.flat:
            raise ValueError("contact 'mujoco' knows planes without obstacles only")
        self._forces, self._normal = setup.forces, ground.rotation()[:, 2]

        def text(pairs: Sequence[Pair]) -> str:
            return tree_mjcf(robot, setup.trunk, ground.slope, pairs)

        try:
            self.model = mj.MjModel.from_xml_string(_with_contact(robot, text) if own else text(()))
        except ValueError as error:
            raise PlantError(f"MuJoCo refused the model: {' '.join(str(error).split())}") from None
        model = self.model
        model.opt.gravity[2] = -options.gravity
        self.data = mj.MjData(model)
        self.data.qpos[:] = setup.start
        self._accelerate()
        self._leg_of = {model.geom(foot_of(leg)).id: k for k, leg in enumerate(robot.legs) if own}

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
            if not speed @ speed < WILD**2:  # not a number neither
                return False
        data.time = end
        q[:], v[:] = position, speed
        return True

    def _accelerate(self) -> None:
        """Find the accelerations, under the forces at the present coordinates and speeds."""
        self.data.qfrc_applied[:] = self._forces.acting(self.data.qpos, self.data.qvel)
        # mj_step would also look for a motion that broke down, and reset it with a warning
        mj.mj_forward(self.model, self.data)

    def mass_matrix(self) -> Array:
        """Mass matrix; see ``Engine``."""
        columns = np.zeros((self.model.nv, self.model.nv))
        for column, unit in zip(columns, np.eye(self.model.nv), strict=True):
            mj.mj_mulM(self.model, self.data, column, unit)
        return columns

    def own_contact(self, q: Array, force: Array, load: Array) -> None:
        """Forces of MuJoCo's own contact; see ``Engine``."""
        force[:], load[:] = 0.0, 0.0
        forces, found = force.reshape(-1, 3), np.zeros(6)
        for at in range(self.data.ncon):
            contact: Any = self.data.contact[at]
            mj.mj_contactForce(self.model, self.data, at, found)
            world = found[:3] @ contact.frame.reshape(3, 3)
            leg = self._leg_of[contact.geom2]
            forces[leg] += world
            load[leg] += world @ self._normal
