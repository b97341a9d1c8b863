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
from functools import partial
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


class _Timed:
    """An FMU whose steps are timed, each series from where the last one ended."""

    def __init__(self, fmu: FMU2Slave, loops: NativeLoops) -> None:
        self.fmu, self.loops, self.t = fmu, loops, 0.0

    def from_c(self, steps: int = TICKS_PER_REPEAT // 4) -> float:
        """Nanoseconds per step, called by compiled code."""
        begin, self.t = self.t, self.t + steps * TS
        return self.loops.steps(self.fmu.dll.fmi2DoStep, self.fmu.component, begin, TS, steps)

    def through_fmpy(self, steps: int = 2000) -> float:
        """Nanoseconds per step, called by fmpy."""
        start, self.t = self.t, self.t + steps * TS
        begin = perf_counter_ns()
        for n in range(steps):
            self.fmu.doStep(start + n * TS, TS)
        return (perf_counter_ns() - begin) / steps


def _plant(legs: int) -> dict[str, float]:
    own, first = plant.SteppedPlant(legs), plant.SteppedPlant(plant.LEGS[0])
    step, four, ratio = _paired(
        lambda: own.step_ns(TICKS_OF_PLANT), lambda: first.step_ns(TICKS_OF_PLANT)
    )
    return {"legs": legs, "step_ns": step, "four_legs_ns": four, "ratio": ratio}


@contextmanager
def _timed(path: Path, loops: NativeLoops, coupled: bool = True) -> Iterator[_Timed]:
    """An FMU, if it is ours in the state and under the loads of ``native.c``."""
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
    if coupled:
        reference = {v.name: v.valueReference for v in description.modelVariables}
        fmu.setBoolean([reference["stored"]], [True])
        fmu.setReal([reference[f"phi_stored[{k}]"] for k in (1, 2, 3)], [3.0, 0.1, 3.0])
        loads = [24.525 / 4 * (0.8 + 0.01 * leg) for leg in range(4)]
        fmu.setReal([reference[f"leg[{i}].grf"] for i in range(1, 5)], loads)
    fmu.exitInitializationMode()
    try:
        yield _Timed(fmu, loops)
    finally:
        fmu.terminate()
        fmu.freeInstance()
        shutil.rmtree(folder, ignore_errors=True)


def _do_step() -> dict[str, float]:
    with NativeLoops(4) as loops, _timed(host_fmu(), loops) as fmu:
        do_step, core, ratio = _paired(fmu.from_c, lambda: loops.core(TICKS_PER_REPEAT // 4))
        through = statistics.median(fmu.through_fmpy() for _ in range(REPEATS))
    return {"from_c_ns": do_step, "core_ns": core, "ratio": ratio, "through_fmpy_ns": through}


def _against_peer() -> dict[str, float]:
    result: dict[str, float] = {}
    with (
        tempfile.TemporaryDirectory() as folder,
        NativeLoops(4) as loops,
        _timed(host_fmu(), loops) as own,
        _timed(peer.export(Path(folder)), loops, coupled=False) as other,
    ):
        for way, of_peer, of_own in (
            ("from_c", other.from_c, own.from_c),
            ("through_fmpy", other.through_fmpy, own.through_fmpy),
        ):
            times = _paired(partial(of_peer, STEPS_OF_PEER), of_own)
            names = (f"{way}_ns", f"own_{way}_ns", f"ratio_{way}")
            result |= dict(zip(names, times, strict=True))
    return result
