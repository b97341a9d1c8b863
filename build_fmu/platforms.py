"""The platforms a binary can be built for, and which binary of an FMU fits this machine."""

from __future__ import annotations

import os
import platform
import struct
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

MODEL: Final = "Apnc"
_ALIGNMENT: Final = 14
"""Pages of Apple silicon have 2^14 bytes."""


class BuildError(ValueError):
    """A build cannot be made or has no binary for this machine; the message is one line."""


@dataclass(frozen=True)
class Platform:
    """A platform a binary can be built for: its folders in the FMU and how zig calls it.

    ``folder`` is the name of FMI 2.0.5, ``tuple`` that of FMI 3.0. ``opened`` is the folder that
    importers of FMI 2.0 open on this system whatever its processor.
    """

    folder: str
    tuple: str
    zig_target: str
    suffix: str
    opened: str

    def folder_for(self, fmi: int) -> str:
        """Name of the folder below ``binaries/`` in that version of FMI."""
        return self.folder if fmi == 2 else self.tuple


PLATFORMS: Final[dict[str, Platform]] = {
    p.folder: p
    for p in (
        Platform("linux64", "x86_64-linux", "x86_64-linux-gnu.2.17", ".so", "linux64"),
        Platform("aarch64-linux", "aarch64-linux", "aarch64-linux-gnu.2.17", ".so", "linux64"),
        Platform("win64", "x86_64-windows", "x86_64-windows-gnu", ".dll", "win64"),
        Platform("darwin64", "x86_64-darwin", "x86_64-macos.10.15", ".dylib", "darwin64"),
        Platform("aarch64-darwin", "aarch64-darwin", "aarch64-macos.11.0", ".dylib", "darwin64"),
    )
}


def check_platforms(names: Iterable[str]) -> None:
    """Refuse names that no platform has.

    Raises:
        BuildError: an unknown platform.
    """
    for name in names:
        if name not in PLATFORMS:
            raise BuildError(f"platform '{name}' is not one of {', '.join(PLATFORMS)}")


def host_platform() -> str:
    """Folder name of the platform this Python runs on.

    Raises:
        BuildError: no binary can be built for it.
    """
    machine = platform.machine().lower()
    arm = machine in ("arm64", "aarch64")
    names = {
        "linux": "aarch64-linux" if arm else "linux64",
        "darwin": "aarch64-darwin" if arm else "darwin64",
        "win32": "win64",
    }
    if sys.platform not in names or not (arm or machine in ("x86_64", "amd64")):
        raise BuildError(
            f"platform {sys.platform} on {machine} is not one of {', '.join(PLATFORMS)}"
        )
    return names[sys.platform]


def place(platform: Platform, fmi: int, model: str = MODEL) -> str:
    """Path in the FMU of the library of a platform."""
    return f"binaries/{platform.folder_for(fmi)}/{model}{platform.suffix}"


def placed(libraries: Mapping[str, bytes], fmi: int, model: str = MODEL) -> dict[str, bytes]:
    """Libraries by their path in the FMU.

    Args:
        libraries: library by name of its platform.
        fmi: version of the standard, 2 or 3.
        model: name of the model.

    Importers of FMI 2.0 open ``darwin64`` and ``linux64`` on ARM machines too. So ``darwin64``
    holds both processors in one file, and an FMU for ARM Linux alone fills ``linux64`` as well.
    """
    files = {place(PLATFORMS[name], fmi, model): library for name, library in libraries.items()}
    if fmi == 2:
        if {"darwin64", "aarch64-darwin"} <= set(libraries):
            both = (libraries["darwin64"], libraries["aarch64-darwin"])
            files[place(PLATFORMS["darwin64"], fmi, model)] = universal(both)
        for name, library in libraries.items():
            files.setdefault(place(PLATFORMS[PLATFORMS[name].opened], fmi, model), library)
    return files


def universal(slices: tuple[bytes, ...]) -> bytes:
    """One Mach-O file for several processors: a big-endian header, then each file aligned.

    Args:
        slices: thin 64-bit Mach-O files, one per processor.
    """
    page = 1 << _ALIGNMENT
    header = struct.pack(">II", 0xCAFEBABE, len(slices))
    body, start = b"", page
    for content in slices:
        processor = struct.unpack_from("<II", content, 4)
        header += struct.pack(">IIIII", *processor, start, len(content), _ALIGNMENT)
        body += content + bytes(-len(content) % page)
        start = page + len(body)
    return header + bytes(page - len(header)) + body


def library_of(folder: Path, fmi: int = 2, model: str = MODEL) -> Path:
    """The library in an unpacked FMU that this machine can load.

    Args:
        folder: where the FMU was unpacked.
        fmi: version of the standard, 2 or 3.
        model: name of the model.

    FMPy takes the path as ``libraryPath``; by itself it opens ``linux64`` on ARM too.

    Raises:
        BuildError: the FMU has none.
    """
    host = PLATFORMS[host_platform()]
    for name in (host.folder_for(fmi), *([host.opened] if fmi == 2 else [])):
        path = folder / "binaries" / name / (model + host.suffix)
        if path.is_file():
            return path
    found = sorted(p.name for p in (folder / "binaries").glob("*") if p.is_dir())
    raise BuildError(
        f"no binary for {host.folder_for(fmi)}: the FMU has {', '.join(found) or 'sources only'}"
    )


def why_not_loaded(error: Exception, folder: Path) -> str:
    """One line on a library in ``folder`` that the system did not load.

    Args:
        error: what the loader, or FMPy, raised.
        folder: where the FMU was unpacked.
    """
    no_exec = getattr(os, "ST_NOEXEC", 0)
    if no_exec and os.statvfs(folder).f_flag & no_exec:
        return (
            f"{folder} forbids execution (mounted noexec), so the FMU's binary cannot be loaded "
            "from there: set TMPDIR to a folder that allows it"
        )
    return f"the FMU's binary for this machine does not load: {error}"
