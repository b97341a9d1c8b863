"""Parameters that give MuJoCo's own contact the stiffness, damping and friction of a robot file."""

from __future__ import annotations

from typing import Final, NamedTuple

from apnc_plant.robot.model import RobotDescription

REGULARISING_MASS: Final = 0.01
"""1/R of the normal direction [kg], see :func:`pair_of`. It is small against the mass of a foot."""

IMPRATIO: Final = 100.0
"""R of the normal direction over R along the ground [1]."""


STEP: Final = 1.0 / 1920.0
"""Integration step of an exported robot [s]. A longer step falsifies the contact force."""

GEOM_MASS: Final = 0.5
"""Least 1/R of a foot on any other geom, over the apparent mass of the foot, see
:func:`geom_of`."""


class Pair(NamedTuple):
    """Parameters of a contact pair.

    Args:
        impedance: d [1].
        normal: stiffness and damping of the reference acceleration along the normal.
        along: the same along the ground.
    """

    impedance: float
    normal: tuple[float, float]
    along: tuple[float, float]


class Geom(NamedTuple):
    """Parameters of a contact that is no pair.

    Args:
        impedance: d [1].
        normal: stiffness and damping of the reference acceleration along the normal; MuJoCo uses
            the same along the ground.
    """

    impedance: float
    normal: tuple[float, float]


def pair_of(robot: RobotDescription, admittance: float) -> Pair:
    """Parameters of the pair of a foot and the ground.

    MuJoCo finds f from a + R f = a_ref, with a the acceleration at the contact,
    a_ref = -b v - d k r, R = A (1 - d) / d and A the admittance (its documentation, 'Solver
    parameters'). So f = (d k r + b v + a) (-1/R). The last term acts like a mass of 1/R attached to
    the foot; 1/R is chosen so small that it does not matter. k and b then follow from the wanted
    stiffness and damping. Along the ground R is smaller by ``IMPRATIO``. The damping there is that
    of the robot file's friction under a foot that carries half the weight, mu m g / (2 v_reg).

    Pitfall: if the damping of the normal direction held along the ground as well, a foot that
    slides at v would get a large extra normal force, mu b v / R, because MuJoCo projects on the
    friction cone in the metric of R.

    Args:
        robot: the robot.
        admittance: A of the foot, MuJoCo's ``body_invweight0`` [1/kg].
    """
    d, normal = _along_normal(robot, admittance, REGULARISING_MASS)
    viscous = robot.contact.friction * robot.weight / 2.0 / robot.contact.friction_speed
    along = (0.0, d * viscous / (REGULARISING_MASS * IMPRATIO))
    return Pair(impedance=d, normal=normal, along=along)


def geom_of(robot: RobotDescription, admittance: float) -> Geom:
    """Parameters of a foot on any geom that forms no pair with it.

    The stiffness is again that of the robot file. Only a pair can set the damping along the ground
    by itself; here it is ``IMPRATIO`` times that along the normal. With the small 1/R of a pair the
    foot would chatter, because the friction in one step would more than reverse its sliding speed.
    So 1/R, which acts like a mass attached to the foot, is made large enough for the step.

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
    # MuJoCo divides k by d^2 and b by d before it uses them
    return d, (d * robot.contact.stiffness / mass, d * robot.contact.damping / mass)
