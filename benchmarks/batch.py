"""Many closed loops in C on one core: without records, with records, and with summaries."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Final

import apnc
from apnc.loop.batch import Batch, Run, contacts_of, fmu_of, lanes_of
from apnc.loop.controller_library import controller_library
from apnc.loop.engines import COMPILED
from apnc_plant.library import library
from benchmarks.closed_loop import against_exudyn, in_exudyn
from benchmarks.command import Size, main
from benchmarks.machine import levels, one_core
from benchmarks.rows import Row, in_turn, processor_s, wall_s

WALKS: Final = 32
"""Walks of a measurement: the lanes of a batch are filled some times."""

NEEDED: Final = {0: 35.0, 1: 150.0, 2: 150.0}
"""Times as fast as Exudyn that a batch without records should be, by level."""


def experiments(count: int, duration: float) -> list[apnc.Experiment]:
    """Walks that differ by their seed."""
    return [apnc.Experiment(engine=COMPILED, duration=duration, seed=seed) for seed in range(count)]


def walked(
    walks: Iterable[apnc.Experiment], level: int | None = None, *, recorded: bool = True
) -> Iterator[Run]:
    """Runs as they end, side by side on this thread.

    Args:
        walks: experiments that can walk side by side.
        level: instruction set, see ``plant.h``; the best of this machine if omitted.
        recorded: whether C writes a record.
    """
    left = list(walks)
    batch = Batch(lanes_of(left[0]), contacts_of(left), level=level)
    while left or batch.free < batch.size:
        while batch.free and left:
            run = Run(left.pop(), batch.controller)
            if not recorded:
                ffi, _ = library()
                run.at.plant_record = run.at.controller_record = ffi.NULL
            batch.begin(run)
        yield from batch.walk(2**30)


def in_batch(
    duration: float, level: int, *, recorded: bool, summaries: bool
) -> Callable[[], float]:
    """A measurement: time of the processor for one of ``WALKS`` walks [s]."""

    def measured() -> float:
        walks = experiments(WALKS, duration)
        begin = time.process_time()
        for run in walked(walks, level, recorded=recorded):
            if recorded:
                record = run.record()
                if summaries:
                    apnc.walk_features(record)
        return (time.process_time() - begin) / WALKS

    return measured


def parts(duration: float) -> dict[str, Callable[[], float]]:
    """Measurements of what a walk is made of beside the robot, by name [s]."""
    walks = experiments(WALKS, duration)
    controller = controller_library(fmu_of(walks[0]))

    def prepared() -> float:
        return processor_s(lambda: [Run(walk, controller) for walk in walks]) / WALKS

    def in_controller() -> float:
        spent = (float(run.at.controller_s) for run in walked(walks, recorded=False))
        return sum(spent) / WALKS

    def summarised() -> float:
        records = [run.record() for run in walked(walks)]
        return processor_s(lambda: [apnc.walk_features(record) for record in records]) / WALKS

    return {
        "of which preparing the run": prepared,
        "of which the controller": in_controller,
        "of which the summary": summarised,
    }


def many(workers: int, duration: float) -> float:
    """Wall time of ``simulate_many`` for one of many walks [s]."""
    walks = experiments(4 * WALKS, duration)
    return wall_s(lambda: apnc.simulate_many(walks, workers=workers)) / len(walks)


def measure(size: Size) -> list[Row]:
    """Time of the processor for a walk, at each instruction set; wall time on two threads."""
    own: dict[str, Callable[[], float]] = {}
    aims: dict[str, float] = {}
    for level, name in levels().items():
        aims[f"{name}, no records"] = NEEDED[level]
        for words, recorded, summaries in (
            ("no records", False, False),
            ("records", True, False),
            ("summaries", True, True),
        ):
            own[f"{name}, {words}"] = in_batch(
                size.duration, level, recorded=recorded, summaries=summaries
            )
    with one_core(size.core), in_exudyn(size) as others:
        times = in_turn(own | parts(size.duration) | others, size.rounds)
    rows = [row for what in own for row in against_exudyn(what, size, times, least=aims.get(what))]
    rows += [row for what in others for row in against_exudyn(what, size, times)]
    names = {f"simulate_many, workers: {n}": partial(many, n, size.duration) for n in (1, 2)}
    walls = in_turn(names, size.rounds)
    one, two = walls
    unit = f"s for {size.duration:g} s"
    return [
        *rows,
        *(Row(what, unit, times[what]) for what in parts(size.duration)),
        Row(f"{one}, wall time", unit, walls[one]),
        Row(f"{two}, wall time", unit, walls[two], "one worker", walls[one]),
    ]


if __name__ == "__main__":
    main({"batch": measure}, __doc__)
