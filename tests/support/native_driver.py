"""Builds the C drivers of support/native and runs them for other machines (wine, qemu)."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import fmpy
import numpy as np
import pytest

from apnc_core.schema import Causality, Type
from apnc_core.variables import scalars
from build_fmu.options import MODEL, PLATFORMS, host_platform
from build_fmu.writing import write_atomically

NATIVE = Path(__file__).parent / "native"
HEADERS = Path(fmpy.__file__).parent / "c-code"
ARM_LIBRARIES = Path("/usr/aarch64-linux-gnu")
WINE = ("wine64", "/usr/lib/wine/wine64", "wine")

LOADS = [s.value_reference for s in scalars() if s.variable.name == "grf"]
MODULATORY_INPUT = next(s.value_reference for s in scalars() if s.variable.name == "MI")
OUTPUTS = [
    s
    for s in scalars()
    if s.variable.causality in (Causality.output, Causality.local) and s.variable.type is Type.real
]
INTEGERS = {s.name: s.value_reference for s in scalars() if s.variable.enumeration}


@dataclass(frozen=True)
class Runner:
    """How a program of another platform is started here."""

    command: tuple[str, ...] = ()
    environment: tuple[tuple[str, str], ...] = ()


def runner(folder: str, scratch: Path) -> Runner:
    """Runner for programs of a platform; skips the test, naming what is missing."""
    if folder == host_platform():
        return Runner()
    if folder == "win64":
        wine = next(filter(None, map(shutil.which, WINE)), None)
        if wine is None:
            pytest.skip("wine64 is missing (Debian package wine64)")
        return Runner((wine,), (("WINEPREFIX", str(scratch / "wine")), ("WINEDEBUG", "-all")))
    if folder == "aarch64-linux":
        qemu = shutil.which("qemu-aarch64")
        if qemu is None:
            pytest.skip("qemu-aarch64 is missing (Debian package qemu-user)")
        if not ARM_LIBRARIES.is_dir():
            pytest.skip(f"{ARM_LIBRARIES} is missing (Debian package libc6-arm64-cross)")
        return Runner((qemu, "-L", str(ARM_LIBRARIES)))
    pytest.skip(f"no emulator runs programs of {folder}")


def compile_native(source: str, folder: str, scratch: Path, *flags: str) -> Path:
    """The program made from ``source`` for a platform."""
    program = scratch / f"{Path(source).stem}-{folder}.exe"
    if not program.is_file():
        part = program.with_suffix(".part.exe")
        command = [sys.executable, "-m", "ziglang", "cc", "-target", PLATFORMS[folder].zig_target]
        command += [
            "-std=c11",
            "-O1",
            "-ffp-contract=off",
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Werror",
        ]
        command += ["-I", str(HEADERS), str(NATIVE / source), "-o", str(part), *flags]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        write_atomically(program, part.read_bytes())
        program.chmod(0o755)
    return program


def drive(
    folder: str, fmu: Path, scratch: Path, ticks: int, settings: dict[str, int], MI: float = 0.08
) -> np.ndarray:
    """Bits of all Real outputs, shape (ticks, outputs), as the library of a platform gives them.

    MI is given in thousandths.
    """
    guid = fmpy.read_model_description(str(fmu), validate=False).guid
    pairs = [x for name, value in settings.items() for x in (INTEGERS[name], value)]
    numbers = [ticks, round(1000 * MI), len(LOADS), *LOADS, MODULATORY_INPUT]
    numbers += [len(settings), *pairs]
    numbers += [s.value_reference for s in OUTPUTS]
    library = fmu / "binaries" / folder / (MODEL + PLATFORMS[folder].suffix)
    return _run("driver.c", folder, scratch, library, guid, numbers, len(OUTPUTS))


def drive_plant(
    folder: str, fmu: Path, scratch: Path, ticks: int, settings: dict[str, int]
) -> np.ndarray:
    """As ``drive``, of a robot that is commanded; settings are its Integers and enumerations."""
    description = fmpy.read_model_description(str(fmu), validate=False)
    reference = {v.name: v.valueReference for v in description.modelVariables}
    commands = [v.valueReference for v in description.modelVariables if v.causality == "input"]
    outputs = [
        v.valueReference
        for v in description.modelVariables
        if v.causality == "output" and v.type == "Real"
    ]
    pairs = [x for name, value in settings.items() for x in (reference[name], value)]
    numbers = [ticks, 100, len(commands) - 1, *commands, len(settings), *pairs, *outputs]
    library = fmu / "binaries" / folder / (description.modelName + PLATFORMS[folder].suffix)
    return _run("plant_driver.c", folder, scratch, library, description.guid, numbers, len(outputs))


def drive3(
    folder: str, fmu: Path, scratch: Path, ticks: int, settings: dict[str, int]
) -> np.ndarray:
    """As ``drive``, with the library of an FMU of FMI 3.0; the outputs in the same order."""
    token = fmpy.read_model_description(str(fmu), validate=False).instantiationToken
    pairs = [x for name, value in settings.items() for x in (INTEGERS[name], value)]
    numbers = [ticks, LOADS[0], len(LOADS), len(OUTPUTS), len(settings), *pairs]
    numbers += [s.value_reference for s in OUTPUTS if s.element == 0]
    platform = PLATFORMS[folder]
    library = fmu / "binaries" / platform.folder_for(3) / (MODEL + platform.suffix)
    return _run("driver3.c", folder, scratch, library, token, numbers, len(OUTPUTS))


def _run(
    source: str,
    folder: str,
    scratch: Path,
    library: Path,
    token: str,
    numbers: list[int],
    columns: int,
) -> np.ndarray:
    how = runner(folder, scratch)
    libraries = () if folder == "win64" else ("-ldl",)
    program = compile_native(source, folder, scratch, *libraries)
    done = subprocess.run(
        [*how.command, str(program), str(library), token, *map(str, numbers)],
        env={**os.environ, **dict(how.environment)},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    rows = [[int(word, 16) for word in line.split()] for line in done.stdout.splitlines()]
    bits = np.array(rows, dtype=np.uint64)
    assert bits.shape == (numbers[0], columns)
    return bits


def load(seed: int, tick: int, foot: int) -> tuple[int, float]:
    """Next seed and load [N], as in importer.h: bits of the drivers can be compared with others."""
    seed = (seed * 6364136223846793005 + 1442695040888963407) % 2**64
    period = 41 + 3 * foot
    return seed, 8 + 6 * ((seed >> 11) / 2**53) if tick % period < period // 2 else 0.0
