"""The plant in Exudyn: time of an integration step by number of legs."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Final

import numpy as np

from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from exudyn_models.plant import Plant

LEGS: Final = (4, 6, 8)
TICK: Final = 1 / 60


def robot_with(legs: int) -> RobotDescription:
    """Lilibot with an even number of legs, spread between the places of its front and hind legs."""
    own = load_robot("lilibot")
    places = np.linspace(own.legs[0].mount[0], own.legs[1].mount[0], legs // 2)
    sides = (own.legs[0], own.legs[-1])
    more = (
        replace(leg, name=f"{leg.name[0]}{i}", mount=(float(x), *leg.mount[1:]))
        for leg in sides
        for i, x in enumerate(places)
    )
    return replace(own, legs=tuple(more))


class SteppedPlant:
    """A robot that swings its legs to and fro where it stands."""

    def __init__(self, legs: int) -> None:
        self._plant = Plant(robot_with(legs))
        self._swing = np.resize([0.1, -0.1], legs)
        self._ticks = 0

    def step_ns(self, ticks: int) -> float:
        """Nanoseconds of processor time per integration step, over so many ticks."""
        begin = time.process_time_ns()
        for _ in range(ticks):
            self._ticks += 1
            self._plant.advance(self._swing * np.sin(0.12 * self._ticks), 0.0 * self._swing, TICK)
        return (time.process_time_ns() - begin) / (ticks * round(TICK / PlantOptions().step))
