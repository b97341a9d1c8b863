"""``apnc bench``: ratios from one run, every pair measured in turn so that drift cancels."""

from __future__ import annotations

import os
import platform
import shutil
import statistics
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter_ns
from typing import Any, Final

import fmpy
from fmpy.fmi2 import FMU2Slave

import apnc_core
from apnc.bench import peer, plant
from apnc.bench.native import NativeLoops
from build_fmu.build import cached_fmu, host_fmu
from build_fmu.options import PLATFORMS, BuildOptions

LEGS: Final = (4, 6, 8, 16, 32, 64)
TS: Final = 1 / 60
REPEATS: Final = 25
TICKS_PER_REPEAT: Final = 80_000  # of one leg
STEPS_OF_PEER: Final = 300
TICKS_OF_PLANT: Final = 20

Progress = Callable[[str], None]


def run_bench(progress: Progress = lambda what: None) -> dict[str, Any]:
    """Measure everything and return plain data for JSON.

    Args:
        progress: called with what is measured next.

    Times are medians in nanoseconds, ratios medians of the ratios of measurements taken in turn.
    """
    result: dict[str, Any] = {"machine": machine(), "targets": TARGETS, "core": []}
    for legs in LEGS:
        progress(f"core, {legs} legs")
        result["core"].append(_core(legs))
    progress("fmi2DoStep")
    result["do_step"] = _do_step()
    progress("plant")
    result["plant"] = [_plant(legs) for legs in plant.LEGS]
    progress("PythonFMU")
    result["pythonfmu"] = _against_peer() if peer.available() else None
    progress("size of the FMU with all platforms")
    result["fmu_bytes"] = cached_fmu(BuildOptions(), progress).stat().st_size
    result["fmu_platforms"] = list(PLATFORMS)
    return result


TARGETS: Final = {
    "core_over_libm_4_legs": 0.6,
    "core_over_libm_64_legs": 0.4,
    "do_step_over_core": 1.3,
    "pythonfmu_over_do_step": 100,
    "fmu_bytes": 1_000_000,
}


def machine() -> dict[str, str]:
    """What the figures come from."""
    return {
        "processor": _processor(),
        "system": f"{platform.system()} {platform.machine()}, libc {platform.libc_ver()[1]}",
        "python": platform.python_version(),
        "apnc": apnc_core.__version__,
        "commit": _commit(),
    }


def _processor() -> str:
    info = Path("/proc/cpuinfo")
    if info.is_file():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                return f"{line.split(':')[1].strip()}, {os.cpu_count()} cores"
    return f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"


def _commit() -> str:
    folder = Path(__file__).resolve().parent
    command = ["git", "-C", str(folder), "describe", "--always", "--dirty", "--abbrev=12"]
    if shutil.which("git") is None:
        return "unknown"
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def _paired(a: Callable[[], float], b: Callable[[], float]) -> tuple[float, float, float]:
    a(), b()
    pairs = [(a(), b()) for _ in range(REPEATS)]
    return (
        statistics.median(x for x, _ in pairs),
        statistics.median(y for _, y in pairs),
        statistics.median(x / y for x, y in pairs),
    )


def _core(legs: int) -> dict[str, float]:
    with NativeLoops(legs) as own, NativeLoops(legs, libm=True) as libm:
        ticks = TICKS_PER_REPEAT // legs
        core, before, ratio = _paired(lambda: own.core(ticks), lambda: libm.core(ticks))
    return {
        "legs": legs,
        "core_ns": core,
        "libm_ns": before,
        "ratio": ratio,
        "sines_and_cosines_per_tick": 4 * legs,
        "tanh_per_tick": 2 * legs,
    }


def _plant(legs: int) -> dict[str, float]:
    own, first = plant.SteppedPlant(legs), plant.SteppedPlant(plant.LEGS[0])
    step, four, ratio = _paired(
        lambda: own.step_ns(TICKS_OF_PLANT), lambda: first.step_ns(TICKS_OF_PLANT)
    )
    return {"legs": legs, "step_ns": step, "four_legs_ns": four, "ratio": ratio}


@contextmanager
def _slave(path: Path, start: Callable[[FMU2Slave, Any], None]) -> Iterator[FMU2Slave]:
    description = fmpy.read_model_description(str(path))
    folder = fmpy.extract(str(path))
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="bench",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    start(fmu, {v.name: v.valueReference for v in description.modelVariables})
    fmu.exitInitializationMode()
    try:
        yield fmu
    finally:
        fmu.terminate()
        fmu.freeInstance()
        shutil.rmtree(folder, ignore_errors=True)


def _start_coupled(fmu: FMU2Slave, reference: dict[str, int]) -> None:
    """The state and loads of ``native.c``: a stored gait, constant loads."""
    fmu.setBoolean([reference["stored"]], [True])
    fmu.setReal([reference[f"phi_stored[{k}]"] for k in (1, 2, 3)], [3.0, 0.1, 3.0])
    loads = [24.525 / 4 * (0.8 + 0.01 * leg) for leg in range(4)]
    fmu.setReal([reference[f"leg[{i}].grf"] for i in range(1, 5)], loads)


class _Clock:
    """Communication points that go on from call to call."""

    def __init__(self) -> None:
        self.t = 0.0

    def take(self, steps: int) -> float:
        begin, self.t = self.t, self.t + steps * TS
        return begin


def _do_step() -> dict[str, float]:
    steps, clock = TICKS_PER_REPEAT // 4, _Clock()
    with NativeLoops(4) as loops, _slave(host_fmu(), _start_coupled) as fmu:
        function = fmu.dll.fmi2DoStep

        def from_c() -> float:
            return loops.steps(function, fmu.component, clock.take(steps), TS, steps)

        do_step, core, ratio = _paired(from_c, lambda: loops.core(steps))
        through = statistics.median(_through_fmpy(fmu, clock, 2000) for _ in range(REPEATS))
    return {"from_c_ns": do_step, "core_ns": core, "ratio": ratio, "through_fmpy_ns": through}


def _through_fmpy(fmu: FMU2Slave, clock: _Clock, steps: int) -> float:
    t = clock.take(steps)
    begin = perf_counter_ns()
    for n in range(steps):
        fmu.doStep(t + n * TS, TS)
    return (perf_counter_ns() - begin) / steps


def _against_peer() -> dict[str, float]:
    own_clock, peer_clock = _Clock(), _Clock()
    own_steps = TICKS_PER_REPEAT // 4
    with tempfile.TemporaryDirectory() as folder:
        path = peer.export(Path(folder))
        with (
            NativeLoops(4) as loops,
            _slave(host_fmu(), _start_coupled) as own,
            _slave(path, lambda fmu, reference: None) as other,
        ):

            def of(fmu: FMU2Slave, clock: _Clock, steps: int) -> float:
                t = clock.take(steps)
                return loops.steps(fmu.dll.fmi2DoStep, fmu.component, t, TS, steps)

            peer_ns, own_ns, ratio = _paired(
                lambda: of(other, peer_clock, STEPS_OF_PEER),
                lambda: of(own, own_clock, own_steps),
            )
            peer_fmpy, own_fmpy, ratio_fmpy = _paired(
                lambda: _through_fmpy(other, peer_clock, STEPS_OF_PEER),
                lambda: _through_fmpy(own, own_clock, 2000),
            )
    return {
        "from_c_ns": peer_ns,
        "own_from_c_ns": own_ns,
        "ratio_from_c": ratio,
        "through_fmpy_ns": peer_fmpy,
        "own_through_fmpy_ns": own_fmpy,
        "ratio_through_fmpy": ratio_fmpy,
    }
