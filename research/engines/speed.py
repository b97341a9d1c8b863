"""Processor time of a tick in each engine, at each step and at equal force error.

``python -m research.engines.speed`` prints the table.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np

from apnc.loop.engines import plant_in
from apnc.studies.table import markdown
from apnc_plant.options import PlantOptions
from research.contact.measure import GRADUAL, TICK, commands, errors, robot, trot
from research.engines import installed
from research.engines.figures import STYLES

STEPS: Final = (8, 16, 32)
"""Numbers of integration steps per tick to measure."""

FINEST: Final = 256
"""Steps per tick of the reference for the force error, in the same engine."""

USUAL: Final = ("exudyn", 16)
"""Engine and steps per tick to compare all others with."""

Key = tuple[str, int]


class Cost(NamedTuple):
    """Force error [1] of the open-loop trot, and median processor time of a tick [s]."""

    force_error: float
    tick_s: float


def measure(repeats: int = 15, ticks: int = 120) -> dict[Key, Cost]:
    """Cost by engine and steps per tick. The engines walk in turn, so that other load hits all."""
    keys = [(engine, n) for engine in installed() for n in STEPS]
    times: dict[Key, list[float]] = {key: [] for key in keys}
    for _ in range(repeats):
        for key in keys:
            times[key].append(_tick_s(*key, ticks))
    finest = {engine: trot(GRADUAL, FINEST, engine) for engine in installed()}
    return {
        (engine, n): Cost(
            float(errors(trot(GRADUAL, n, engine), finest[engine])["force_error"]),
            float(np.median(times[engine, n])),
        )
        for engine, n in keys
    }


def _tick_s(engine: str, steps: int, ticks: int) -> float:
    plant = plant_in(engine)(robot(GRADUAL), options=PlantOptions(step=TICK / steps))
    begin = time.process_time()
    for tick in range(ticks):
        plant.advance(*commands(tick), TICK)
    return (time.process_time() - begin) / ticks


def at_equal_error(costs: Mapping[Key, Cost], engine: str) -> float:
    """Time of a tick at the force error of ``USUAL`` over the time of ``USUAL``; below 1 is faster.

    Between two measured steps the logarithms of error and time are interpolated linearly. Outside
    of them the nearest two are extrapolated.
    """
    wanted = costs[USUAL]
    own = sorted(cost for (name, _), cost in costs.items() if name == engine)
    above = sum(cost.force_error < wanted.force_error for cost in own)
    at = min(max(1, above), len(own) - 1)
    a, b = own[at - 1], own[at]
    (x0, y0), (x1, y1) = np.log(a), np.log(b)
    share = (np.log(wanted.force_error) - x0) / (x1 - x0)
    return float(np.exp(y0 + share * (y1 - y0)) / wanted.tick_s)


def table(costs: Mapping[Key, Cost]) -> str:
    """A line per engine and steps per tick."""
    usual = costs[USUAL].tick_s
    cost_title = f"time of a tick, Exudyn at {1e3 * TICK / USUAL[1]:.3f} ms = 1"

    def line(key: Key, cost: Cost) -> dict[str, str]:
        engine, steps = key
        return {
            "engine": STYLES[engine][0],
            "step [ms]": f"{1e3 * TICK / steps:.3f}",
            "force error": f"{100.0 * cost.force_error:.1f} %",
            cost_title: f"{cost.tick_s / usual:.2f}",
            "at equal force error": f"{at_equal_error(costs, engine):.2f}" * (steps == USUAL[1]),
        }

    return markdown(line(key, cost) for key, cost in costs.items())


if __name__ == "__main__":
    print(table(measure()))
