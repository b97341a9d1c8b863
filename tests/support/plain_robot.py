"""A robot of four legs that are alike, whose file tests change."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from apnc_plant.robot import RobotDescription, load_robot

PLAIN: Final = Path(__file__).with_name("plain.toml")


def plain_text() -> str:
    """Text of its file."""
    return PLAIN.read_text(encoding="utf-8")


def plain_robot() -> RobotDescription:
    """The robot."""
    return load_robot(PLAIN)
