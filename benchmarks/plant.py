"""Ticks of the robot alone, by how it is computed and with which instructions."""

from __future__ import annotations

from collections.abc import Callable

from apnc.loop.engines import ENGINES, plant_in
from apnc_plant.robot import load_robot
from benchmarks.command import Size, main
from benchmarks.machine import levels, one_core
from benchmarks.rows import Row, in_turn, processor_s
from benchmarks.ticks import KINDS, Trotting, trot_commands
from research.contact.measure import TICK

UNIT = "us per tick and robot"


def in_c(kind: str, level: int, ticks: int, legs: int = 4) -> Callable[[], float]:
    """A measurement of ``Trotting``: time of a tick of one robot [us]."""
    plant = Trotting(kind, level, legs)
    return lambda: 1e6 * processor_s(lambda: plant.walk(ticks)) / (ticks * plant.lanes)


def in_engine(engine: str, ticks: int) -> Callable[[], float]:
    """The same in an engine, called from Python."""
    rows = list(zip(*trot_commands(ticks), strict=True))

    def walk() -> float:
        plant = plant_in(engine)(load_robot("lilibot"))

        def advance() -> None:
            for hip, knee in rows:
                plant.advance(hip, knee, TICK)

        return 1e6 * processor_s(advance) / ticks

    return walk


def measure(size: Size) -> list[Row]:
    """Time of the processor for a tick, and how many times real time that is."""
    ticks = 60 if size.quick else 1200
    measures = {f"Python, {engine}": in_engine(engine, min(ticks, 300)) for engine in ENGINES}
    for level, name in levels().items():
        for kind in KINDS:
            measures[f"C, {kind}, {name}"] = in_c(kind, level, ticks)
    with one_core(size.core):
        times = in_turn(measures, size.rounds)
    against = "Python, exudyn"
    return [
        Row(name, UNIT, values, against, times[against], note=_real_time(values))
        for name, values in times.items()
    ]


def _real_time(values: tuple[float, ...]) -> str:
    return f"{1e6 * TICK / min(values):.0f} times real time in the least"


if __name__ == "__main__":
    main({"plant": measure}, __doc__)
