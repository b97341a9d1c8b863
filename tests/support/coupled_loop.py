"""Both FMUs of a system, stepped by FMPy in one loop in which values may come late.

Tools differ in when they pass values on. What a tool gives is held to this loop with its delays,
bit for bit.
"""

from __future__ import annotations

import shutil
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from named_fmu import FMU2Named
from numpy.typing import NDArray

from apnc.system.structure import Structure

TICK = 1.0 / 60.0


class FMU2Part(FMU2Named):
    """One FMU of a system."""

    def put(self, names: Sequence[str], values: Sequence[float]) -> None:
        self.setReal([self.reference[name] for name in names], list(values))


@contextmanager
def started(folder: Path, structure: Structure, which: int) -> Iterator[FMU2Part]:
    """An FMU of a system with its start values, initialized."""
    part = structure.components[which]
    fmu = FMU2Part(folder / part.source)
    setters = {"Real": fmu.setReal, "Integer": fmu.setInteger, "Boolean": fmu.setBoolean}
    try:
        fmu.instantiate()
        fmu.setupExperiment(startTime=0.0)
        for start in structure.starts:
            if start.component == part.name:
                setters[start.type]([start.reference], [start.value])
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        yield fmu
        fmu.terminate()
        fmu.freeInstance()
    finally:
        shutil.rmtree(fmu.folder, ignore_errors=True)


def walk(
    folder: Path,
    structure: Structure,
    seconds: float,
    *,
    loads: int = 0,
    commands: int = 0,
    before: str = "start",
    step: float = TICK,
    nanoseconds: bool = False,
) -> dict[str, NDArray[np.float64]]:
    """What controller and plant show after every step.

    Args:
        folder: the system, as ``build_system`` wrote it.
        structure: the same as plain data.
        seconds: simulated time [s].
        loads, commands: steps by which they come late.
        before: what comes before the first: ``start``, what the FMUs show at the start, or
            ``zero``.
        step: communication step [s].
        nanoseconds: time is counted in whole ones, as libcosim does.
    """
    links: dict[str, tuple[list[str], list[str]]] = {"controller": ([], []), "plant": ([], [])}
    for (part, output), (_, entry) in structure.connections:
        links[part][0].append(output)
        links[part][1].append(entry)
    rows = []
    with started(folder, structure, 0) as brain, started(folder, structure, 1) as body:
        late = {
            "plant": _queue(body, links["plant"][0], loads, before),
            "controller": _queue(brain, links["controller"][0], commands, before),
        }
        for n in range(round(seconds / step)):
            t, h = _step(n, step, nanoseconds)
            _pass(body, brain, links["plant"], late["plant"])
            brain.doStep(t, h)
            _pass(brain, body, links["controller"], late["controller"])
            body.doStep(t, h)
            rows.append(_shown(brain, body, structure))
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _step(n: int, step: float, nanoseconds: bool) -> tuple[float, float]:
    """Begin and length of a step [s]."""
    if not nanoseconds:
        return n * step, step
    begin, end = (k * int(1e9 * step) / 1e9 for k in (n, n + 1))
    return begin, end - begin


def _queue(fmu: FMU2Part, outputs: list[str], late: int, before: str) -> deque[list[float]]:
    first = fmu.get(outputs) if before == "start" else [0.0] * len(outputs)
    return deque([first] * late)


def _pass(
    source: FMU2Part, sink: FMU2Part, link: tuple[list[str], list[str]], late: deque[list[float]]
) -> None:
    outputs, inputs = link
    late.append(source.get(outputs))
    sink.put(inputs, late.popleft())


def _shown(brain: FMU2Part, body: FMU2Part, structure: Structure) -> dict[str, list[float]]:
    flat = "leg1_grf" in body.reference
    legs = range(1, len(structure.legs) + 1)
    by_leg = {x: [f"leg{i}_{x}" if flat else f"leg[{i}].{x}" for i in legs] for x in _BY_LEG}
    place = [f"position{'_' if flat else '.'}{x}" for x in "xyz"]
    return {
        "o1": brain.get(by_leg["o1"]),
        "o2": brain.get(by_leg["o2"]),
        "grf": body.get(by_leg["grf"]),
        "position": body.get(place),
    }


_BY_LEG = ("o1", "o2", "grf")
