"""One closed loop of controller and robot, with its record: in C against Exudyn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final

import apnc
from benchmarks import before
from benchmarks.command import Size, main
from benchmarks.machine import one_core
from benchmarks.rows import Row, in_turn, processor_s

EXUDYN: Final = "Exudyn"
"""The closed loop in Exudyn, which all others are compared with."""

_IN_A_ROW: Final = {"compiled": 5, "mujoco": 1, "exudyn": 1}
"""Walks of an engine after each other: one in C is over too soon to be timed well."""

Measures = dict[str, Callable[[], float]]


def walk(engine: str, duration: float) -> apnc.Record:
    """A walk to its end.

    Raises:
        RuntimeError: it ended early, so its time is not that of a walk.
    """
    record = apnc.simulate(apnc.Experiment(engine=engine, duration=duration))
    if not record.complete:
        raise RuntimeError(f"{engine}: {record.end} at {record.ended_at:.2f} s")
    return record


def walk_in(engine: str, duration: float) -> Callable[[], float]:
    """A measurement: time of the processor for a walk and its record [s]."""
    return lambda: processor_s(lambda: walk(engine, duration), _IN_A_ROW[engine])


@contextmanager
def in_exudyn(size: Size) -> Iterator[Measures]:
    """Measurements of the closed loops in Exudyn that others are compared with, by name."""
    measures = {EXUDYN: walk_in("exudyn", size.duration)}
    if size.before is None:
        yield measures
        return
    with before.before(size.before) as other:
        yield measures | {before.NAME: lambda: other.walk_s(size.duration)}


def against_exudyn(
    what: str,
    size: Size,
    times: dict[str, tuple[float, ...]],
    *,
    least: float | None = None,
    note: str = "",
) -> list[Row]:
    """Rows of a time against those of :func:`in_exudyn`, which has the aim against the own."""
    unit = f"s for {size.duration:g} s"
    rows = [Row(what, unit, times[what], EXUDYN, times[EXUDYN], least, note=note)]
    if before.NAME in times:
        rows.append(Row(what, unit, times[what], before.NAME, times[before.NAME], least))
    return rows


def measure(size: Size) -> list[Row]:
    """Time of the processor for a walk."""
    names = {"C": "compiled", "MuJoCo": "mujoco"}
    own = {name: walk_in(engine, size.duration) for name, engine in names.items()}
    with one_core(size.core), in_exudyn(size) as others:
        times = in_turn(own | others, size.rounds)
    return [
        *against_exudyn("C", size, times, least=40.0),
        *against_exudyn("MuJoCo", size, times),
        *against_exudyn(EXUDYN, size, times),
    ]


if __name__ == "__main__":
    main({"closed_loop": measure}, __doc__)
