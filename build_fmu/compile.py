"""Compile the sources to one shared library, with the C compiler of the ``ziglang`` package."""

from __future__ import annotations

import importlib.metadata
import logging
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from build_fmu.cache import cache_folder, temporary_folder
from build_fmu.platforms import MODEL, BuildError, Platform

BuildProgress = Callable[[str], None]
"""Called with the name of the platform that is compiled next."""

LOG: Final = logging.getLogger("build_fmu")
"""Says at level INFO what is compiled, and how long it took."""

INSTALL_COMPILER: Final = "pip install ziglang"
NO_COMPILER: Final = f"the C compiler is not installed: {INSTALL_COMPILER}"

FLAGS: Final = (
    "-std=c11",
    "-O2",
    # rounding is then the same on all platforms and in the Python reference
    "-ffp-contract=off",
    # the code reads no errno; the compiler may then compute sine and cosine of a number together
    "-fno-math-errno",
    "-fvisibility=hidden",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Werror",
)
_LINUX_FLAGS: Final = ("-fPIC", "-Wl,-z,defs", "-lm")


def compiler_version() -> str:
    """Version of the installed compiler; empty if there is none."""
    try:
        return importlib.metadata.version("ziglang")
    except importlib.metadata.PackageNotFoundError:
        return ""


def _platform_flags(platform: Platform, name: str) -> tuple[str, ...]:
    if platform.suffix == ".so":
        return _LINUX_FLAGS
    if platform.suffix == ".dylib":
        return ("-fPIC", f"-Wl,-install_name,@rpath/{name}.dylib")
    return ()


def compile_library(
    folder: Path,
    c_files: list[str],
    platform: Platform,
    name: str = MODEL,
    flags: tuple[str, ...] = (),
) -> bytes:
    """Bytes of the stripped shared library.

    Args:
        folder: folder that holds all sources.
        c_files: names of the files to compile.
        platform: what to compile for.
        name: of the library, without its suffix.
        flags: more flags.

    Raises:
        BuildError: the compiler is not installed or failed; the message holds its output.
    """
    if not compiler_version():
        raise BuildError(NO_COMPILER)
    # zig compiles its runtime library once per platform and keeps it in this cache
    caches = {"ZIG_GLOBAL_CACHE_DIR": str(cache_folder() / "zig")}
    with temporary_folder() as out:
        library = Path(out) / (name + platform.suffix)
        command = [
            *(sys.executable, "-m", "ziglang", "cc", "-target", platform.zig_target),
            *("-shared", "-s", *FLAGS, *flags, *_platform_flags(platform, name)),
            *("-I.", *c_files, "-o", str(library)),
        ]
        LOG.info("compiling %s for %s", name, platform.folder)
        begin = time.monotonic()
        done = subprocess.run(
            command,
            cwd=folder,
            env=caches | os.environ,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            raise BuildError(f"compiler failed for {platform.folder}:\n{done.stderr.strip()}")
        LOG.info("compiled %s for %s in %.1f s", name, platform.folder, time.monotonic() - begin)
        return library.read_bytes()
