"""Compile the sources to one shared library, with the C compiler of the ``ziglang`` package."""

from __future__ import annotations

import importlib.metadata
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Final

from build_fmu.cache import cache_folder
from build_fmu.platforms import MODEL, BuildError, Platform

Progress = Callable[[str], None]
"""Called with the name of the platform that is compiled next."""

FLAGS: Final = (
    "-std=c11",
    "-O2",
    # the same rounding everywhere, as the Python reference has it
    "-ffp-contract=off",
    # nobody reads errno, and sine and cosine of one number may then be computed together
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
        BuildError: the compiler failed, and the message carries what it said; or there is none.
    """
    if not compiler_version():
        raise BuildError('the compiler is not installed: pip install "apnc[build]"')
    # the compiler's own run time is built once per platform and kept beside the FMUs
    caches = {"ZIG_GLOBAL_CACHE_DIR": str(cache_folder() / "zig")}
    with tempfile.TemporaryDirectory() as out:
        library = Path(out) / (name + platform.suffix)
        command = [
            *(sys.executable, "-m", "ziglang", "cc", "-target", platform.zig_target),
            *("-shared", "-s", *FLAGS, *flags, *_platform_flags(platform, name)),
            *("-I.", *c_files, "-o", str(library)),
        ]
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
        return library.read_bytes()
