"""MuJoCo's own contact, set so that it is the spring, damper and friction of the robot file."""

from __future__ import annotations

from typing import Final, NamedTuple

from apnc_plant.robot.model import RobotDescription

REGULARISING_MASS: Final = 0.01
"""1/R of the normal direction [kg], see :func:`pair_of`: small beside a foot with its rotors."""

IMPRATIO: Final = 100.0
"""R of the normal direction over R along the ground."""


class Pair(NamedTuple):
    """Parameters of a contact pair: impedance d, and (stiffness, damping) of the reference
    acceleration along the normal and along the ground."""

    impedance: float
    normal: tuple[float, float]
    along: tuple[float, float]


def pair_of(robot: RobotDescription, admittance: float) -> Pair:
    """Parameters of the pair of a foot and the ground.

    MuJoCo finds f from a + R f = a_ref, with a the acceleration at the contact,
    a_ref = -b v - d k r, R = A (1 - d) / d and A the admittance (its documentation, 'Solver
    parameters'). So f = (d k r + b v + a) (-1/R): with 1/R small the last term, a mass of 1/R that
    hangs on the foot, does not count, and k and b follow from the wanted stiffness and damping.
    Along the ground R is smaller by ``IMPRATIO``; the damping there is that of the robot file's
    friction under a foot that carries half the weight, mu m g / (2 v_reg).

    Pitfall: with the damping of the normal direction along the ground as well, a foot that slides
    at v gets an extra normal force of mu b v / R, hundreds of N s/m, since MuJoCo projects on the
    cone in the metric of R.

    Args:
        robot: the robot.
        admittance: A of the foot, MuJoCo's ``body_invweight0`` [1/kg].
    """
    contact, mass = robot.contact, REGULARISING_MASS
    d = mass * admittance / (1.0 + mass * admittance)
    viscous = contact.friction * robot.weight / 2.0 / contact.friction_speed
    return Pair(
        impedance=d,
        # MuJoCo divides k by d^2 and b by d before it takes them
        normal=(d * contact.stiffness / mass, d * contact.damping / mass),
        along=(0.0, d * viscous / (mass * IMPRATIO)),
    )
