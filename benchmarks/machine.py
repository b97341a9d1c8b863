"""What the figures come from, and where they are measured."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from apnc.studies.machine import commit, processor
from apnc_plant.library import library

ROOT: Final = Path(__file__).resolve().parent.parent
"""The checkout."""

PACKAGES: Final = ("numpy", "scipy", "exudyn", "mujoco", "fmpy", "cffi")
"""Whose versions count."""


def machine() -> dict[str, str]:
    """Processor, system, versions and commit, by what they are."""
    return {
        "processor": processor(),
        "instruction sets": ", ".join(levels().values()),
        "system": f"{platform.system()} {platform.machine()}, libc {platform.libc_ver()[1]}",
        "load": load(),
        "priority": f"nice {os.nice(0)}" if hasattr(os, "nice") else "",
        "date": time.strftime("%Y-%m-%d %H:%M"),
        "commit": commit(),
        "python": platform.python_version(),
        "compiler": f"zig {_version('ziglang')}",
        **{name: _version(name) for name in PACKAGES},
    }


def load() -> str:
    """Programs that ran or waited, on average over the last minute, and cores."""
    average = f"{os.getloadavg()[0]:.2f}" if hasattr(os, "getloadavg") else "unknown"
    return f"{average} on {os.cpu_count()} cores"


def levels() -> dict[int, str]:
    """Names of the instruction sets of this machine that the robot in C has, by their level."""
    ffi, lib = library()
    return {
        level: ffi.string(lib.plant_level_name(level)).decode()
        for level in range(lib.plant_best_level() + 1)
    }


@contextmanager
def one_core(core: int) -> Iterator[None]:
    """This process stays on one core, if it is above -1 and the system knows of that."""
    if core < 0 or not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {core})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


def _version(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"
