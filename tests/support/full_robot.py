"""A robot whose file says all that a robot file can say."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from apnc_plant.robot import RobotDescription, load_robot

FULL: Final = Path(__file__).with_name("full.toml")


def full_robot() -> RobotDescription:
    """Lilibot with every key, and no leg like another."""
    return load_robot(FULL)
