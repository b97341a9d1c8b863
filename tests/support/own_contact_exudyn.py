"""Exudyn's own contact of the feet with level ground.

It knows neither a damping that sets in gradually nor a field of obstacles.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from exudyn_feet import add_feet, assemble
from own_contact import OwnContactPlant

from apnc_plant.coordinates import BASE
from apnc_plant.legged import Setup
from apnc_plant.robot import RobotDescription
from apnc_plant.robot.links import links_of
from apnc_plant.robot.model import Leg
from exudyn_models.engine import items
from exudyn_models.plant import ExudynTree

GROUND_RADIUS: Final = 1e6
"""Radius of the ball that stands for the plane [m]: 13 um below it after 5 m, 0.1 nm resolution."""

GROUND_STIFFNESS: Final = 1e16
"""Stiffness of the ground [N/m], in series with the foot's: all compliance is the rubber's."""

SEARCH_BOX: Final = 100.0
"""Half width of the contact search tree [m]; contact works beyond it, slower."""


class TouchingTree(ExudynTree):
    """The robot in Exudyn on the plane z = 0, under Exudyn's own contact.

    Normal force max(0, stiffness * penetration + damping * its rate); Coulomb friction,
    proportional to the sliding speed below ``friction_speed``. Pitfall: in Exudyn 1.13 the damper
    of a sphere on a triangle pulls when a foot lifts off; between two spheres it does not. That is
    why the ground is a very large ball.
    """

    def __init__(self, setup: Setup, robot: RobotDescription) -> None:
        super().__init__(setup)
        self._robot, contact = robot, robot.contact
        ground = self.mbs.AddObject(items().ObjectGround())
        below = [0.0, 0.0, -GROUND_RADIUS]
        centre = self.mbs.AddMarker(items().MarkerBodyRigid(bodyNumber=ground, localPosition=below))
        self._contacts: Any = self.mbs.AddGeneralContact()
        self._contacts.SetFrictionPairings(np.array([[contact.friction]]))
        self._contacts.SetFrictionProportionalZone(contact.friction_speed)
        self._contacts.keepContactWhilePenetrating = False
        self._contacts.computeContactForces = True
        for foot in add_feet(self, robot):
            self._contacts.AddSphereWithMarker(
                foot, contact.foot_radius, contact.stiffness, contact.damping, 0
            )
        self._contacts.AddSphereWithMarker(centre, GROUND_RADIUS, GROUND_STIFFNESS, 0.0, 0)
        self._contacts.SetSearchTreeCellSize([1, 1, 1])
        self._contacts.SetSearchTreeBox(
            [-SEARCH_BOX, -SEARCH_BOX, -1.0], [SEARCH_BOX, SEARCH_BOX, 1.0]
        )
        assemble(self)

    def foot_force(self, q: np.ndarray) -> np.ndarray:
        """Force of the ground on each foot, see ``OwnContact``.

        The contact part of the three joint torques of a leg is J^T f, with J the Jacobian of the
        contact point; solving for f needs no sensor. It is the force of the last evaluation of the
        equations of motion, one step old. Pitfall: J is singular for a straight leg.
        """
        legs = self._robot.legs
        generalized = np.asarray(self._contacts.GetSystemODE2RhsContactForces())
        if generalized.size == 0:
            return np.zeros((len(legs), 3))
        trunk = turn("z", q[3]) @ turn("y", q[4]) @ turn("x", q[5])
        down = -self._robot.contact.foot_radius * trunk[2]
        joints, torques = q[BASE:].reshape(-1, 3), generalized[BASE:].reshape(-1, 3)
        rows = zip(legs, joints, torques, strict=True)
        found = [np.linalg.solve(jacobian(leg, own, down).T, torque) for leg, own, torque in rows]
        return np.array(found) @ trunk.T


class Plant(OwnContactPlant):
    """A robot in Exudyn, under Exudyn's own contact."""

    own_contact = TouchingTree


def turn(axis: str, angle: float) -> np.ndarray:
    """Rotation about an axis."""
    c, s = np.cos(angle), np.sin(angle)
    k = "xyz".index(axis)
    matrix = np.eye(3)
    i, j = (k + 1) % 3, (k + 2) % 3
    matrix[np.ix_([i, j], [i, j])] = [[c, -s], [s, c]]
    return matrix


def jacobian(leg: Leg, angles: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Jacobian of a contact point over the joint coordinates of its leg, in the trunk's frame.

    Args:
        leg: the leg.
        angles: tree coordinates of its joints [rad], shape (3,).
        down: from the centre of the foot to the point, in the trunk's frame [m], shape (3,).
    """
    at, frame, places, axes = np.zeros(3), np.eye(3), [], []
    for link, angle in zip(links_of(leg), angles, strict=True):
        at = at + frame @ link.position
        name = "x" if link.axis[0] else "y"
        frame = frame @ turn(name, link.turn)
        places.append(at)
        axes.append(frame @ np.eye(3)["xyz".index(name)])
        frame = frame @ turn(name, angle)
    point = at - frame[:, 2] * leg.tibia_length + down
    return np.cross(axes, point - np.array(places)).T
