"""What makes walking harder, step by step: the cases that are walked."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from apnc.studies.robots import changed
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Kerb, Obstacles, Plane, Waves
from apnc_plant.robot import RobotDescription
from apnc_plant.robot.size import mean_leg_length, times_longer

Fields = Mapping[str, Any]
"""Fields of an experiment by name."""


@dataclass(frozen=True)
class Limit:
    """One thing that makes walking harder.

    Args:
        fields: fields of the experiment for a robot, a value and a seed.
        unit: of the value.
        values: from easy to hard.
        least_way: way ahead that a robot must have gone, so that it has met what is there [m].
    """

    fields: Callable[[RobotDescription, float, int], Fields]
    unit: str
    values: tuple[float, ...]
    least_way: float = 0.0


@dataclass(frozen=True)
class Case:
    """A limit at one of its values."""

    limit: str
    value: float


def _slope(sign: float) -> Callable[[RobotDescription, float, int], Fields]:
    return lambda robot, deg, seed: {"ground": Plane(slope=sign * math.radians(deg))}


def _kerb(robot: RobotDescription, percent: float, seed: int) -> Fields:
    return {"ground": Kerb(at=KERB_AT, height=percent / 100.0 * mean_leg_length(robot))}


def _waves(robot: RobotDescription, percent: float, seed: int) -> Fields:
    leg = mean_leg_length(robot)
    return {"ground": Waves(amplitude=percent / 100.0 * leg, wavelength=WAVE_LEGS * leg)}


def _obstacles(robot: RobotDescription, roughness: float, seed: int) -> Fields:
    return {"ground": Obstacles(roughness=roughness, seed=seed, scale=times_longer(robot))}


def _payload(robot: RobotDescription, percent: float, seed: int) -> Fields:
    return {"conditions": Conditions(payload=percent / 100.0 * robot.mass)}


def _noise(robot: RobotDescription, deviation: float, seed: int) -> Fields:
    return {"conditions": Conditions(grf_noise=deviation)}


def _delay(robot: RobotDescription, ms: float, seed: int) -> Fields:
    return {"robot": changed(robot, "sensor.delay", lambda own: own + 1e-3 * ms)}


def _rate(robot: RobotDescription, hz: float, seed: int) -> Fields:
    return {"rate": hz}


KERB_AT: Final = 0.5
"""Way from the start to the kerb [m]."""

WAVE_LEGS: Final = 3.0
"""Wavelength of the waves over the length of a leg [1]."""

AS_IT_IS: Final = "nothing"
"""The case of the robot on level ground."""

_DEGREES: Final = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 24.0, 28.0, 32.0)
_HEIGHTS: Final = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0, 18.0, 22.0, 26.0, 30.0)

LIMITS: Final[Mapping[str, Limit]] = {
    "slope up": Limit(_slope(1.0), "deg", _DEGREES),
    "slope down": Limit(_slope(-1.0), "deg", _DEGREES),
    "obstacles": Limit(_obstacles, "R", (0.2, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0)),
    "kerb": Limit(_kerb, "% of the leg", _HEIGHTS, least_way=2.0 * KERB_AT),
    "waves": Limit(_waves, "% of the leg", _HEIGHTS),
    "payload": Limit(
        _payload, "% of the mass", (25.0, 50.0, 75.0, 100.0, 125.0, 150.0, 200.0, 250.0, 300.0)
    ),
    "update rate": Limit(
        _rate, "Hz", (50.0, 45.0, 40.0, 35.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 5.0)
    ),
    "noise of the sensors": Limit(
        _noise, "half weights", (0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0)
    ),
    "more delay of the sensors": Limit(
        _delay, "ms", (10.0, 20.0, 30.0, 40.0, 60.0, 80.0, 100.0, 150.0, 200.0, 300.0)
    ),
}
"""By name. Values are swept until the walk fails, or as far as a ground goes: R = 1 is its end."""

CASES: Final[Mapping[str, Case]] = {AS_IT_IS: Case(AS_IT_IS, 0.0)} | {
    f"{name} {value:g} {limit.unit}": Case(name, value)
    for name, limit in LIMITS.items()
    for value in limit.values
}
"""By name on the command line."""
