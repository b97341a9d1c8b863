"""What a tick of the controller costs: its core, ``fmi2DoStep``, and a PythonFMU of the same."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Final

import fmpy
from fmpy.fmi2 import FMU2Slave

from benchmarks import python_fmu
from benchmarks.command import Size, main
from benchmarks.core_loops import CoreLoops
from benchmarks.machine import one_core
from benchmarks.rows import Row, in_turn
from build_fmu.build import cached_fmu, host_fmu
from build_fmu.options import BuildOptions

LEGS: Final = (4, 6, 8, 16, 32, 64)
TS: Final = 1 / 60
TICKS: Final = 80_000
"""Ticks of one leg between two looks at the clock."""
STEPS_OF_PYTHON: Final = 300
"""The same of a controller in Python."""

LEAST_CORE: Final = {4: 1.67, 64: 2.5}
"""Times as fast as with the functions of the C library, by number of legs."""
LEAST_STEP: Final = 0.77
"""``fmi2DoStep`` costs at most 1.3 times what the core in it costs."""
LEAST_PEER: Final = 100.0
"""Times as fast as the controller in Python, exported by PythonFMU."""
MOST_KB: Final = 1000.0
"""Of the FMU with the binaries of five platforms [kB]."""


def measure(size: Size) -> list[Row]:
    """Time of the process for a tick, and the size of the FMU."""
    ticks = TICKS // 40 if size.quick else TICKS
    rows = []
    with one_core(size.core):
        for legs in (4, 6) if size.quick else LEGS:
            rows.append(core(legs, ticks, size.rounds))
        rows += steps(ticks, size.rounds)
        if python_fmu.available():
            rows += against_python(ticks, STEPS_OF_PYTHON // (10 if size.quick else 1), size.rounds)
    if not size.quick:  # five platforms may have to be compiled first
        kilobytes = cached_fmu(BuildOptions()).stat().st_size / 1000.0
        rows.append(Row("FMU with five platforms", "kB", (kilobytes,), most=MOST_KB))
    return rows


def core(legs: int, ticks: int, rounds: int) -> Row:
    """The core, couplings on, against the same with the functions of the C library."""
    own, libm = "own functions", "functions of the C library"
    with CoreLoops(legs) as fast, CoreLoops(legs, libm=True) as slow:
        n = ticks // legs
        times = in_turn({own: lambda: fast.core(n), libm: lambda: slow.core(n)}, rounds)
    return Row(
        f"core, {legs} legs", "ns", times[own], libm, times[libm], least=LEAST_CORE.get(legs)
    )


def steps(ticks: int, rounds: int) -> list[Row]:
    """A step of the FMU, called from C and through fmpy, against its core."""
    with CoreLoops(4) as loops, timed(host_fmu(), loops) as fmu:
        from_c, through = "fmi2DoStep from C, one tick", "doStep through fmpy"
        times = in_turn(
            {
                from_c: lambda: fmu.from_c(ticks // 4),
                "core": lambda: loops.core(ticks // 4),
                through: lambda: fmu.through_fmpy(ticks // 40),
            },
            rounds,
        )
    return [
        Row(from_c, "ns", times[from_c], "core", times["core"], least=LEAST_STEP),
        Row(through, "ns", times[through], from_c, times[from_c]),
    ]


def against_python(ticks: int, steps_of_python: int, rounds: int) -> list[Row]:
    """The same controller in Python, exported by PythonFMU."""
    rows = []
    with (
        tempfile.TemporaryDirectory() as folder,
        CoreLoops(4) as loops,
        timed(host_fmu(), loops) as own,
        timed(python_fmu.export(Path(folder)), loops, coupled=False) as other,
    ):
        for way, of_own, of_other, n, least in (
            ("fmi2DoStep from C", own.from_c, other.from_c, ticks // 4, LEAST_PEER),
            ("doStep through fmpy", own.through_fmpy, other.through_fmpy, ticks // 40, None),
        ):
            peer = f"PythonFMU, {way}"
            found = in_turn({way: partial(of_own, n), peer: partial(of_other, steps_of_python)},
                            rounds)  # fmt: skip
            rows.append(Row(way, "ns", found[way], peer, found[peer], least=least))
    return rows


class TimedSteps:
    """An FMU whose steps are timed, each series from where the last one ended.

    Args:
        fmu: initialised.
        loops: of which one calls it from C.
    """

    def __init__(self, fmu: FMU2Slave, loops: CoreLoops) -> None:
        self._fmu, self._loops, self._t = fmu, loops, 0.0

    def from_c(self, steps: int) -> float:
        """Nanoseconds per step, called by compiled code."""
        begin, self._t = self._t, self._t + steps * TS
        return self._loops.steps(self._fmu.dll.fmi2DoStep, self._fmu.component, begin, TS, steps)

    def through_fmpy(self, steps: int) -> float:
        """Nanoseconds per step, called by fmpy."""
        start, self._t = self._t, self._t + steps * TS
        begin = time.perf_counter_ns()
        for n in range(steps):
            self._fmu.doStep(start + n * TS, TS)
        return (time.perf_counter_ns() - begin) / steps


@contextmanager
def timed(path: Path, loops: CoreLoops, coupled: bool = True) -> Iterator[TimedSteps]:
    """An FMU, if it is ours in the state and under the loads of ``core_loops.c``."""
    description = fmpy.read_model_description(str(path))
    folder = fmpy.extract(str(path))
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="benchmark",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    if coupled:
        reference = {v.name: v.valueReference for v in description.modelVariables}
        fmu.setBoolean([reference["stored"]], [True])
        fmu.setReal([reference[f"phi_stored[{k}]"] for k in (1, 2, 3)], [3.0, 0.1, 3.0])
        loads = [24.525 / 4 * (0.8 + 0.01 * leg) for leg in range(4)]
        fmu.setReal([reference[f"leg[{i}].grf"] for i in range(1, 5)], loads)
    fmu.exitInitializationMode()
    try:
        yield TimedSteps(fmu, loops)
    finally:
        fmu.terminate()
        fmu.freeInstance()
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main({"controller": measure}, __doc__)
