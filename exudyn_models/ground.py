"""Flat ground, and the contact of the feet with it."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from exudyn_models.description import Array, Contact
from exudyn_models.engine import items
from exudyn_models.kinematics import LegState
from exudyn_models.tree import BASE, JOINT_SIGN, Tree

GROUND_RADIUS: Final = 1e6
"""Radius of the ball that stands for the plane [m]: 13 um below it after 5 m, 0.1 nm resolution."""

GROUND_STIFFNESS: Final = 1e16
"""Stiffness of the ground [N/m], in series with the foot's: all compliance is the rubber's."""

SEARCH_BOX: Final = 100.0
"""Half width of the contact search tree [m]; contact works beyond it, slower."""


def add_ground(mbs: Any, tree: Tree, contact: Contact) -> Any:
    """Add the plane z = 0 and its contact with every foot; returns Exudyn's contact set.

    The normal force is max(0, stiffness * penetration + damping * its rate), the friction force
    follows Coulomb's law, proportional to the sliding speed below ``friction_speed``.
    Pitfall: in Exudyn 1.13 the damper of a sphere on a triangle pulls when a foot lifts off (it
    made overdamped feet stick, 18 N at worst); between two spheres it does not. That is why the
    ground is a very large ball.

    Args:
        mbs: the system.
        tree: the robot, whose foot markers carry the balls.
        contact: radius, stiffness, damping and friction of the feet.
    """
    ground = mbs.AddObject(items.ObjectGround())
    centre = mbs.AddMarker(
        items.MarkerBodyRigid(bodyNumber=ground, localPosition=[0.0, 0.0, -GROUND_RADIUS])
    )
    contacts = mbs.AddGeneralContact()
    contacts.SetFrictionPairings(np.array([[contact.friction]]))
    contacts.SetFrictionProportionalZone(contact.friction_speed)
    contacts.keepContactWhilePenetrating = False
    contacts.computeContactForces = True
    for foot in tree.feet:
        contacts.AddSphereWithMarker(
            foot, contact.foot_radius, contact.stiffness, contact.damping, 0
        )
    contacts.AddSphereWithMarker(centre, GROUND_RADIUS, GROUND_STIFFNESS, 0.0, 0)
    contacts.SetSearchTreeCellSize([1, 1, 1])
    contacts.SetSearchTreeBox([-SEARCH_BOX, -SEARCH_BOX, -1.0], [SEARCH_BOX, SEARCH_BOX, 1.0])
    return contacts


def foot_forces(contacts: Any, legs: LegState, trunk: Array, foot_radius: float) -> Array:
    """Force of the ground on each foot, world frame [N], shape (n_legs, 3).

    The contact part Q of the three joint torques of a leg is J^T f, with J the Jacobian of the
    contact point; solving for f needs no sensor item. It is the force of the last evaluation of
    the equations of motion, one step old.
    Pitfall: J is singular for a straight leg, knee and foot in line with the hip.

    Args:
        contacts: Exudyn's contact set, as :func:`add_ground` returned it.
        legs: feet and joint axes in the trunk frame.
        trunk: rotation from trunk to world, shape (3, 3).
        foot_radius: radius of the foot balls [m].
    """
    generalized = np.asarray(contacts.GetSystemODE2RhsContactForces())
    if generalized.size == 0:
        return np.zeros_like(legs.foot)
    torques = generalized[BASE:].reshape(-1, 3) * JOINT_SIGN
    down = -trunk[2]
    jacobian = legs.jacobian(legs.foot + foot_radius * down)
    force = np.linalg.solve(np.swapaxes(jacobian, 1, 2), torques[:, :, None])[:, :, 0]
    return np.asarray(force @ trunk.T)
