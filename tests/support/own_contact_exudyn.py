"""Exudyn's own contact of the feet with level ground, to hold the compiled one against.

It knows neither a damping that sets in gradually nor a field of obstacles, and at the default step
it costs about twice the time; ``PlantOptions(contact="exudyn")`` takes it.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from apnc_plant.coordinates import BASE, JOINT_SIGN
from apnc_plant.robot.model import Array, Contact
from exudyn_models.engine import items
from exudyn_models.physics import forces
from exudyn_models.tree import Tree

GROUND_RADIUS: Final = 1e6
"""Radius of the ball that stands for the plane [m]: 13 um below it after 5 m, 0.1 nm resolution."""

GROUND_STIFFNESS: Final = 1e16
"""Stiffness of the ground [N/m], in series with the foot's: all compliance is the rubber's."""

SEARCH_BOX: Final = 100.0
"""Half width of the contact search tree [m]; contact works beyond it, slower."""


def add_own_contact(mbs: Any, tree: Tree, contact: Contact) -> Any:
    """Add the plane z = 0 and its contact with every foot; returns Exudyn's contact set.

    Normal force max(0, stiffness * penetration + damping * its rate); Coulomb friction,
    proportional to the sliding speed below ``friction_speed``. Pitfall: in Exudyn 1.13 the damper
    of a sphere on a triangle pulls when a foot lifts off; between two spheres it does not. That is
    why the ground is a very large ball.

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


def own_foot_forces(contacts: Any, q: Array, geometry: Array, foot_radius: float) -> Array:
    """Force of the ground on each foot, world frame [N], shape (n_legs, 3).

    The contact part of the three joint torques of a leg is J^T f, with J the Jacobian of the
    contact point; solving for f needs no sensor item. It is the force of the last evaluation of
    the equations of motion, one step old. Pitfall: J is singular for a straight leg.

    Args:
        contacts: Exudyn's contact set.
        q: coordinates of the tree, shape (6 + 3 n_legs,).
        geometry: a row per leg as ``forces.leg_points`` takes it, shape (n_legs, 10).
        foot_radius: radius of the foot balls [m].
    """
    legs = len(geometry)
    generalized = np.asarray(contacts.GetSystemODE2RhsContactForces())
    if generalized.size == 0:
        return np.zeros((legs, 3))
    torques = generalized[BASE:].reshape(legs, 3) * JOINT_SIGN
    joints = q[BASE:].reshape(legs, 3) * JOINT_SIGN
    trunk = np.array(forces.rotation_rpy(q[5], q[4], q[3]))
    down = -foot_radius * trunk[2]
    force = np.empty((legs, 3))
    for k in range(legs):
        hip, knee, foot, axis = map(np.array, forces.leg_points(geometry[k], *joints[k]))
        point = foot + down
        columns = (
            np.cross((1.0, 0.0, 0.0), point - geometry[k, :3]),
            np.cross(axis, point - hip),
            np.cross(axis, point - knee),
        )
        force[k] = np.linalg.solve(np.array(columns), torques[k])
    return np.asarray(force @ trunk.T)
