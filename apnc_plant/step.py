"""Integration step of a robot: the one that it gets, and the longest that is allowed."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final

from apnc_plant.library import library
from apnc_plant.numbers import robot_numbers
from apnc_plant.robot.model import RobotDescription

SHORTEST_STEP: Final = 1e-6
"""Shortest integration step that a robot may need [s]; with a shorter one no walk would end."""


def _in_c(function: str, robot: RobotDescription) -> float:
    numbers = robot_numbers(robot)  # the C function reads its arrays, so it lives until the end
    return float(getattr(library()[1], function)(numbers.at))


@lru_cache
def longest_step(robot: RobotDescription) -> float:
    """Longest integration step that follows the motion of a robot [s].

    It is computed in C from the robot's masses, servos and feet; ``docs/physics/step.md`` says how.
    A payload does not count.
    """
    return _in_c("plant_longest_step", robot)


@lru_cache
def stable_step(robot: RobotDescription) -> float:
    """Longest stable integration step [s]; with a longer one, vibrations grow that no robot has."""
    return _in_c("plant_stable_step", robot)


@lru_cache
def own_step(robot: RobotDescription) -> float:
    """Integration step that a robot gets if none is given [s].

    It is 1/960 s, 16 steps in a tick of 1/60 s, or shorter where the robot needs it.

    Raises:
        ValueError: the robot needs a step below ``SHORTEST_STEP``.
    """
    step = _in_c("plant_own_step", robot)
    if not step >= SHORTEST_STEP:
        raise ValueError(
            f"servos or feet of robot '{robot.name}' are so stiff that it needs integration steps "
            f"of {step:.2g} s; allowed: {SHORTEST_STEP:g} s and more"
        )
    return step


def checked_step(step: float | None, robot: RobotDescription) -> float:
    """The integration step to use [s].

    Args:
        step: what was asked for [s]; None for the robot's own.
        robot: the robot.

    Raises:
        ValueError: the step is longer than the robot allows, or the robot needs too short a step.
    """
    own, longest = own_step(robot), longest_step(robot)
    if step is None:
        return own
    if not step <= longest:
        raise ValueError(
            f"step = {step:g} s is too long for the servos and feet of robot '{robot.name}'; "
            f"allowed: {math.floor(1e6 * longest) / 1e6:g} s and less"
        )
    return step
