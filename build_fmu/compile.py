"""Compile the sources to one shared library, with the C compiler of the ``ziglang`` package."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from build_fmu.options import MODEL, BuildError, Platform

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


def _platform_flags(platform: Platform) -> tuple[str, ...]:
    if platform.suffix == ".so":
        return _LINUX_FLAGS
    if platform.suffix == ".dylib":
        return ("-fPIC", f"-Wl,-install_name,@rpath/{MODEL}.dylib")
    return ()


def compile_library(folder: Path, c_files: list[str], platform: Platform) -> bytes:
    """Bytes of the stripped shared library.

    Args:
        folder: folder that holds all sources.
        c_files: names of the files to compile.
        platform: what to compile for.

    Raises:
        BuildError: the compiler failed; the message carries what it said.
    """
    with tempfile.TemporaryDirectory() as out:
        library = Path(out) / (MODEL + platform.suffix)
        command = [
            *(sys.executable, "-m", "ziglang", "cc", "-target", platform.zig_target),
            *("-shared", "-s", *FLAGS, *_platform_flags(platform)),
            *("-I.", *c_files, "-o", str(library)),
        ]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise BuildError(f"compiler failed for {platform.folder}:\n{done.stderr.strip()}")
        return library.read_bytes()
