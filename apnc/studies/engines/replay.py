"""The same commands in both engines: they end the closer to each other the finer the step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc.loop.engines import OWN_ENGINE, plant_in
from apnc.studies.contact.measure import TICK, commands
from exudyn_models.physics.options import PlantOptions
from exudyn_models.robot import load_robot

Array = NDArray[np.float64]

STEPS: Final = (32, 64, 128, 256, 512)
"""Integration steps per tick."""

LENGTH: Final = 1.0
"""Length of a replay [s]."""


def path_of(engine: str, steps: int, length: float = LENGTH) -> Array:
    """Place of the trunk after every tick of the open-loop trot [m], shape (ticks, 3).

    Args:
        engine: of the plant.
        steps: integration steps per tick.
        length: of the trot [s].
    """
    plant = plant_in(engine)(load_robot("lilibot"), options=PlantOptions(step=TICK / steps))
    trace = plant.trace()
    for tick in range(round(length / TICK)):
        plant.advance(*commands(tick), TICK)
        trace.take()
    return np.asarray(trace.channels()["position"])


def distances(steps: Sequence[int] = STEPS, other: str = "mujoco") -> Array:
    """Distance between the trunks in the two engines at the end, per number of steps [m]."""
    ends = [[path_of(engine, n)[-1] for engine in (OWN_ENGINE, other)] for n in steps]
    return np.array([np.linalg.norm(a - b) for a, b in ends])


def order_of(steps: Sequence[int], values: Sequence[float] | Array) -> float:
    """Order p of an error that goes with the p-th power of the step, by least squares."""
    return float(-np.polyfit(np.log(steps), np.log(values), 1)[0])
