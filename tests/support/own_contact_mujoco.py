"""MuJoCo's own contact of the feet with a plane: the very one that an exported robot has."""

from __future__ import annotations

from math import cos, sin
from typing import Any
from xml.etree import ElementTree

import numpy as np
from own_contact import OwnContactPlant

from apnc_plant.legged import Setup
from apnc_plant.robot import RobotDescription
from mujoco_models.engine import mj
from mujoco_models.mjcf import foot_of, tree_mjcf
from mujoco_models.tree import MujocoTree, export_mjcf


class TouchingTree(MujocoTree):
    """The robot in MuJoCo on a plane, under MuJoCo's own contact.

    Damping that sets in with depth, and friction in proportion to the load below
    ``friction_speed``, it does not know.
    """

    def __init__(self, setup: Setup, robot: RobotDescription) -> None:
        super().__init__(setup)
        text = tree_mjcf(robot, setup.trunk)
        gravity = self.model.opt.gravity
        self.model = mj().MjModel.from_xml_string(with_ground(text, robot, setup.ground.slope))
        self.model.opt.gravity[:] = gravity
        self.data = mj().MjData(self.model)
        self.data.qpos[:] = setup.start
        self._accelerate()
        self._leg_of = {self.model.geom(foot_of(leg)).id: k for k, leg in enumerate(robot.legs)}

    def foot_force(self, q: np.ndarray) -> np.ndarray:
        """Force of the ground on each foot, see ``OwnContact``."""
        forces, found = np.zeros((len(self._leg_of), 3)), np.zeros(6)
        for at in range(self.data.ncon):
            contact: Any = self.data.contact[at]
            mj().mj_contactForce(self.model, self.data, at, found)
            forces[self._leg_of[contact.geom2]] += found[:3] @ contact.frame.reshape(3, 3)
        return forces


class Plant(OwnContactPlant):
    """A robot in MuJoCo, under MuJoCo's own contact."""

    own_contact = TouchingTree


def with_ground(text: str, robot: RobotDescription, slope: float) -> str:
    """The model with the ground and the contacts of the exported robot, the ground tilted."""
    model, exported = map(ElementTree.fromstring, (text, export_mjcf(robot)))
    world, ground = model.find("worldbody"), exported.find("worldbody/geom[@name='ground']")
    contacts = exported.find("contact")
    assert world is not None and ground is not None and contacts is not None
    ground.set("quat", f"{cos(slope / 2.0)} 0 {-sin(slope / 2.0)} 0")
    world.append(ground)
    model.append(contacts)
    return ElementTree.tostring(model, encoding="unicode")
