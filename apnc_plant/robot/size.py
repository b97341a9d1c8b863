"""Size of a robot against that of Lilibot, on which absolute numbers were found."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from apnc_plant.robot.model import RobotDescription

LILIBOT_MASS: Final = 2.5
"""Mass of Lilibot [kg]."""

LILIBOT_LEG: Final = 0.070 + 0.085
"""Length of femur and tibia of Lilibot [m]."""


def leg_length(robot: RobotDescription) -> float:
    """Femur and tibia of the longest leg of a robot [m]."""
    return max(leg.femur_length + leg.tibia_length for leg in robot.legs)


def mean_leg_length(robot: RobotDescription) -> float:
    """Femur and tibia [m], mean over the legs of a robot."""
    lengths = [leg.femur_length + leg.tibia_length for leg in robot.legs]
    return sum(lengths) / len(lengths)


def times_longer(robot: RobotDescription) -> float:
    """Leg of a robot over that of Lilibot, for which this is exactly 1 [1]."""
    return leg_length(robot) / LILIBOT_LEG


def times_heavier(robot: RobotDescription) -> float:
    """Mass of a robot over that of Lilibot, for which this is exactly 1 [1]."""
    return robot.mass / LILIBOT_MASS
