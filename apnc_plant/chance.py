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
    if isinstance(seed, Integral) and not isinstance(seed, bool) and 0 <= seed <= LARGEST_SEED:
        return int(seed)
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
    side, amount = (
        lib.plant_uniform(checked_seed(seed), lib.PLANT_RANDOM_BODY, index) for index in (0, 1)
    )
    sign = -1.0 if side < 0.5 else 1.0
    return float(sign * robot.trunk.com_side_offset * (0.75 + 0.5 * amount))
