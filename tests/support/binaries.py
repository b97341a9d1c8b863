"""What the libraries of an FMU offer and need, whatever platform they are for."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from native_driver import HEADERS

from build_fmu.platforms import PLATFORMS

lief = pytest.importorskip("lief", reason="lief is missing (PyPI package lief)")

LINKERS_OWN = {"__dso_handle", "_mh_dylib_header"}
"""Marks that zig's linker sets in every Mach-O library and has no option to hide."""


def standard_functions(fmi: int = 2) -> set[str]:
    """Functions of co-simulation, from the header of the standard."""
    header = (HEADERS / f"fmi{fmi}Functions.h").read_text()
    if fmi == 3:  # every library offers those of all kinds of FMU
        return set(re.findall(r"FMI3_Export\s+\w+TYPE\s+(\w+);", header))
    common = header[header.rindex("\nCommon Functions") :]  # behind the renaming macros
    before, _, rest = common.partition("Functions for FMI2 for Model Exchange")
    _, _, after = rest.partition("Functions for FMI2 for Co-Simulation")
    return set(re.findall(r"FMI2_Export\s+\w+TYPE\s+(\w+);", before + after))


def slice_of(path: Path, platform: str) -> object:
    """The binary for a platform; one of two in a universal file for Macs."""
    if PLATFORMS[platform].suffix != ".dylib":
        return lief.parse(str(path))
    kind = lief.MachO.Header.CPU_TYPE
    wanted = kind.ARM64 if platform == "aarch64-darwin" else kind.X86_64
    return lief.MachO.parse(str(path)).take(wanted)


def exports(library: object) -> set[str]:
    if isinstance(library, lief.PE.Binary):
        return {entry.name for entry in library.get_export().entries}
    if isinstance(library, lief.MachO.Binary):
        return {
            s.name.removeprefix("_") for s in library.symbols if s.has_export_info
        } - LINKERS_OWN
    return {s.name for s in library.exported_symbols}  # type: ignore[attr-defined]


def needed_of_glibc(library: Any) -> tuple[int, ...]:
    """Newest version of the C library of Linux that is asked for."""
    names = {a.name for r in library.symbols_version_requirement for a in r.get_auxiliary_symbols()}
    assert names and all(re.fullmatch(r"GLIBC_2(\.\d+)+", name) for name in names), names
    return max(tuple(map(int, name.removeprefix("GLIBC_").split("."))) for name in names)


def part_of_windows(library: Any) -> bool:
    """Whether all that is needed has been part of the system since Windows 10."""
    part_of_the_system = re.compile(r"kernel32\.dll|api-ms-win-crt-\w+-l1-1-0\.dll")
    names = {entry.name.lower() for entry in library.imports}
    return bool(names) and all(part_of_the_system.fullmatch(name) for name in names)


def oldest_mac(library: Any) -> list[int]:
    """Oldest version of macOS."""
    return list(library.build_version.minos)
