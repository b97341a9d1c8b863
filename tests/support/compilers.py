"""Compilers and tools of the system, for tests of the C sources; a missing one skips by name."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

CORE = Path(__file__).parents[2] / "fmu_src" / "core"
NATIVE = Path(__file__).parent / "native"
CORE_FILES = [CORE / "controller.c", CORE / "apnc_variables.c"]
STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Werror")
SANITIZERS = ("-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


def tool(name: str, package: str) -> str:
    """Path of a program; skips the test if it is missing."""
    found = shutil.which(name)
    if found is None:
        pytest.skip(f"{name} is missing (Debian package {package})")
    return found


def run(*command: str | Path, cwd: Path | None = None) -> str:
    """What a command that must succeed printed."""
    done = subprocess.run(
        [str(word) for word in command], cwd=cwd, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
