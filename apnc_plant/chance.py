"""Random numbers: one generator in C, addressed by seed and purpose."""

from __future__ import annotations

from numbers import Integral
from typing import Final

from apnc_plant.library import library
from apnc_plant.robot.model import RobotDescription

LARGEST_SEED: Final = 2**64 - 1


def checked_seed(seed: object) -> int:
    """The seed as an ``int``.

    Raises:
        ValueError: the seed is not a whole number from 0 to 2^64 - 1.
    """
    if isinstance(seed, Integral) and not isinstance(seed, bool):
        number = int(seed)
        if 0 <= number <= LARGEST_SEED:
            return number
    raise ValueError(f"seed is {seed!r}; allowed: a whole number from 0 to 2^64 - 1")


def side_offset(robot: RobotDescription, seed: int) -> float:
    """Sideways error of a trunk's centre of mass [m].

    Its side is random, and its amount is random within a quarter of the size that the robot says.

    Args:
        robot: its ``trunk.com_side_offset`` is the size of the error.
        seed: 0 to 2^64 - 1.

    Raises:
        ValueError: the seed is not allowed.
    """
    _, lib = library()
    return float(lib.plant_side_offset(checked_seed(seed), robot.trunk.com_side_offset))
