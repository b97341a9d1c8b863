"""Timed loops in C over the controller, compiled for one number of legs and loaded here."""

from __future__ import annotations

import contextlib
import ctypes
import tempfile
import time
from pathlib import Path
from typing import Final

from build_fmu import sources
from build_fmu.compile import compile_library
from build_fmu.options import PLATFORMS, BuildOptions, host_platform

_CORE_FILES: Final = ("controller.c", "apnc_variables.c", "core_loops.c")

# time of this process where that is fine enough: other programs then do not count
_FINE: Final = time.get_clock_info("process_time").resolution <= 1e-6
_now_ns: Final = time.process_time_ns if _FINE else time.perf_counter_ns


class CoreLoops(contextlib.ExitStack):
    """Loops over the core and the ``fmi2DoStep`` of any loaded FMU.

    Args:
        legs: number of legs the core is compiled for.
        coupled: whether the neural couplings are on, the most expensive case.
        libm: with the elementary functions of the C library instead of our own.
    """

    def __init__(self, legs: int, coupled: bool = True, libm: bool = False) -> None:
        super().__init__()
        made = tempfile.TemporaryDirectory(prefix="apnc-bench-", ignore_cleanup_errors=True)
        folder = Path(self.enter_context(made))
        platform = PLATFORMS[host_platform()]
        files = sources.collect() | {
            "apnc_config.h": b"#define APNC_LIBM\n" * libm
            + sources.config_header(BuildOptions(legs=legs, platforms=()), ""),
            "core_loops.c": Path(__file__).with_suffix(".c").read_bytes(),
        }
        for name, text in files.items():
            (folder / name).write_bytes(text)
        library = folder / f"bench{platform.suffix}"
        library.write_bytes(compile_library(folder, list(_CORE_FILES), platform))
        self._library = ctypes.CDLL(str(library))
        self._library.bench_core.restype = ctypes.c_double
        self._library.bench_steps.argtypes = [
            *(ctypes.c_void_p, ctypes.c_void_p),
            *(ctypes.c_double, ctypes.c_double, ctypes.c_int),
        ]
        self._library.bench_start(int(coupled))

    def core(self, ticks: int) -> float:
        """Nanoseconds per tick of the core."""
        begin = _now_ns()
        self._library.bench_core(ticks)
        return (_now_ns() - begin) / ticks

    def steps(self, do_step: object, component: object, t: float, h: float, n: int) -> float:
        """Nanoseconds per call of an FMU's ``fmi2DoStep``.

        Raises:
            RuntimeError: a step failed.
        """
        address = ctypes.cast(do_step, ctypes.c_void_p)  # type: ignore[arg-type]  # any function
        begin = _now_ns()
        status = self._library.bench_steps(address, component, t, h, n)
        spent = _now_ns() - begin
        if status > 1:
            raise RuntimeError(f"fmi2DoStep failed with status {status}")
        return spent / n
