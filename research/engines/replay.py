"""The same commands in all engines: how far apart are the trunks?"""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc.loop.engines import OWN_ENGINE, plant_in
from apnc_core.types import Array
from apnc_plant.robot import load_robot
from research.contact.measure import TICK, commands

LENGTH: Final = 10.0
"""Length of a replay [s]."""


def path_of(engine: str, length: float = LENGTH) -> Array:
    """Position of the trunk after every tick of the open-loop trot [m], shape (ticks, 3).

    Args:
        engine: name of the engine.
        length: length of the trot [s].
    """
    plant = plant_in(engine)(load_robot("lilibot"))
    trace = plant.trace()
    for tick in range(round(length / TICK)):
        plant.advance(*commands(tick), TICK)
        trace.take()
    return np.asarray(trace.signals()["position"])


def distances(engine: str, length: float = LENGTH) -> Array:
    """Distance between the trunks in an engine and in Exudyn after every tick [m].

    Args:
        engine: name of the engine to compare with Exudyn.
        length: length of the trot [s].
    """
    own, its = path_of(OWN_ENGINE, length), path_of(engine, length)
    return np.asarray(np.linalg.norm(own - its, axis=1))
