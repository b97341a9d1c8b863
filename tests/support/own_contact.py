"""Plants whose feet are carried by a contact that is not ours, to hold our law against it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from apnc_plant.legged import Engine, LeggedPlant, Setup
from apnc_plant.robot import RobotDescription


class OwnContact(Engine, Protocol):
    """An engine with a contact of its own."""

    def __init__(self, setup: Setup, robot: RobotDescription) -> None:
        """Build the equations of motion.

        Args:
            setup: what to build; our contact does not act in it.
            robot: the robot with the contact that is asked for.
        """

    def foot_force(self, q: np.ndarray) -> np.ndarray:
        """Force of the ground on every foot, world frame [N], shape (n_legs, 3).

        Args:
            q: coordinates, shape (6 + 3 n_legs,).
        """


class OwnContactPlant(LeggedPlant):
    """A plant with all that ours has, except that its engine says what acts on the feet."""

    own_contact: type[OwnContact]

    def __init__(self, robot: RobotDescription, *arguments: Any, **options: Any) -> None:
        self._touching = robot
        super().__init__(without_contact(robot), *arguments, **options)

    def engine(self, setup: Setup) -> OwnContact:  # type: ignore[override]
        return self.own_contact(setup, self._touching)

    def _measure(self) -> None:
        super()._measure()
        forces = self._engine.foot_force(self._q)
        self._forces.force[:] = forces.ravel()
        self._forces.load[:] = forces @ self._ground.rotation()[:, 2]


def without_contact(robot: RobotDescription) -> RobotDescription:
    """A robot that falls through the ground: nothing of our law is left but rounding."""
    none = replace(robot.contact, stiffness=1e-12, damping=0.0, friction=0.0)
    return replace(robot, contact=none)
