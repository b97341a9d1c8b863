"""MuJoCo's own contact, set so that it is the spring, damper and friction of the robot file."""

from __future__ import annotations

from typing import Final, NamedTuple

from apnc_plant.robot.model import RobotDescription

REGULARISING_MASS: Final = 0.01
"""1/R of the normal direction [kg], see :func:`pair_of`: small beside a foot with its rotors."""

IMPRATIO: Final = 100.0
"""R of the normal direction over R along the ground."""


STEP: Final = 1.0 / 1920.0
"""Integration step of an exported robot [s]; at twice that its contact is 21 % off in force."""

GEOM_MASS: Final = 0.5
"""1/R of a foot on any other geom, at least, over the mass that the foot has there, see
:func:`geom_of`."""


class Pair(NamedTuple):
    """Parameters of a contact pair: impedance d, and (stiffness, damping) of the reference
    acceleration along the normal and along the ground."""

    impedance: float
    normal: tuple[float, float]
    along: tuple[float, float]


class Geom(NamedTuple):
    """Parameters of a contact without a pair: impedance d, and (stiffness, damping) of the
    reference acceleration along the normal, which MuJoCo takes along the ground, too."""

    impedance: float
    normal: tuple[float, float]


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
    d, normal = _along_normal(robot, admittance, REGULARISING_MASS)
    viscous = robot.contact.friction * robot.weight / 2.0 / robot.contact.friction_speed
    along = (0.0, d * viscous / (REGULARISING_MASS * IMPRATIO))
    return Pair(impedance=d, normal=normal, along=along)


def geom_of(robot: RobotDescription, admittance: float) -> Geom:
    """Parameters of a foot on whatever is no pair with it.

    They give the stiffness of the robot file, too. Only a pair can say the damping along the
    ground; here it is ``IMPRATIO`` times that of the normal, and with the small 1/R of a pair the
    foot would chatter: the friction of a step changes its speed by more than the speed there is.
    So 1/R, the mass that hangs on the foot while it touches, is large enough for the step.

    Args:
        robot: the robot.
        admittance: A of the foot [1/kg], as for :func:`pair_of`.
    """
    mass = max(GEOM_MASS / admittance, robot.contact.damping * STEP)
    return Geom(*_along_normal(robot, admittance, mass))


def _along_normal(
    robot: RobotDescription, admittance: float, mass: float
) -> tuple[float, tuple[float, float]]:
    """Impedance, stiffness and damping, given 1/R [kg]."""
    d = mass * admittance / (1.0 + mass * admittance)
    # MuJoCo divides k by d^2 and b by d before it takes them
    return d, (d * robot.contact.stiffness / mass, d * robot.contact.damping / mass)
