"""What is drawn by chance: numbers of one generator in C, by seed and purpose."""

from __future__ import annotations

from numbers import Integral
from typing import Final

from apnc_plant.library import library
from apnc_plant.robot.model import RobotDescription

LARGEST_SEED: Final = 2**64 - 1


def checked_seed(seed: object) -> int:
    """The seed as a plain number.

    Raises:
        ValueError: not a whole number from 0 to 2^64 - 1.
    """
    if isinstance(seed, Integral) and not isinstance(seed, bool):
        number = int(seed)
        if 0 <= number <= LARGEST_SEED:
            return number
    raise ValueError(f"seed is {seed!r}; allowed: a whole number from 0 to 2^64 - 1")


def side_offset(robot: RobotDescription, seed: int) -> float:
    """Sideways error of a trunk's centre of mass [m]: side and amount, within a quarter, by chance.

    Args:
        robot: says the size of the error.
        seed: 0 to 2^64 - 1.

    Raises:
        ValueError: another seed.
    """
    _, lib = library()
    return float(lib.plant_side_offset(checked_seed(seed), robot.trunk.com_side_offset))
