"""Ticks over the number of legs: a part for the trunk, and a part for each leg.

The times are held to a straight line in the number of legs, least squares of the relative errors;
how far the farthest is off it says whether anything grows faster than the legs do.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import Final

import apnc
from apnc.loop.engines import COMPILED
from benchmarks.batch import walked
from benchmarks.command import Size, main
from benchmarks.fits import line
from benchmarks.machine import levels, one_core
from benchmarks.plant import in_c
from benchmarks.rows import Row, in_turn
from benchmarks.ticks import KINDS, robot_with

LEGS: Final = (4, 8, 16, 32, 64)

MOST_OFF: Final = 20.0
"""[%] by which any may be off the line."""

_WALKS: Final = 8


def closed_loop(duration: float, legs: int) -> Callable[[], float]:
    """A measurement: time of the processor for a tick of controller and robot, no records [us]."""
    robot = robot_with(legs)
    walks = [
        apnc.Experiment(robot=robot, engine=COMPILED, duration=duration, seed=seed)
        for seed in range(_WALKS)
    ]

    def measured() -> float:
        begin = time.process_time()
        ticks = sum(run.ticks for run in walked(walks, recorded=False))
        return 1e6 * (time.process_time() - begin) / ticks

    return measured


def measure(size: Size) -> list[Row]:
    """Time of the processor for a tick by number of legs, and how far from a line it is."""
    best, name = max(levels().items())
    duration, ticks = 5.0, 30 if size.quick else 600
    ways: dict[str, Callable[[int], Callable[[], float]]] = {
        f"robot alone, {kind}, {name}": partial(in_c, kind, best, ticks) for kind in KINDS
    }
    if not size.quick:  # its controllers may have to be built first
        ways[f"closed loop, robots, {name}"] = partial(closed_loop, duration)
    rows = []
    for words, measurement in ways.items():
        with one_core(size.core):
            times = in_turn({str(legs): measurement(legs) for legs in LEGS}, size.rounds)
        trunk, leg, _ = line(LEGS, [min(values) for values in times.values()])
        off = tuple(line(LEGS, values)[2] for values in zip(*times.values(), strict=True))
        found = f"{trunk:.2f} us and {leg:.3f} us per leg"
        for legs, values in times.items():
            note = f"{statistics.median(values) / int(legs):.3f} us per leg"
            rows.append(Row(f"{words}, {legs} legs", "us per tick", values, note=note))
        rows.append(Row(f"{words}, farthest from a line", "%", off, most=MOST_OFF, note=found))
    return rows


if __name__ == "__main__":
    main({"legs": measure}, __doc__)
