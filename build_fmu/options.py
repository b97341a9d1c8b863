"""What can be chosen about a build."""

from __future__ import annotations

import platform
import sys
from dataclasses import dataclass
from typing import Final

from apnc_core.schema import MAX_LEGS

MODEL: Final = "Apnc"
FMI_VERSIONS: Final = (2, 3)
NAMINGS: Final = ("structured", "flat")


@dataclass(frozen=True)
class Platform:
    """A platform a binary can be built for: its folders in the FMU and how zig calls it.

    ``folder`` is the name of FMI 2.0.5, ``tuple`` that of FMI 3.0.
    """

    folder: str
    tuple: str
    zig_target: str
    suffix: str

    def folder_for(self, fmi: int) -> str:
        """Name of the folder below ``binaries/`` in that version of FMI."""
        return self.folder if fmi == 2 else self.tuple


PLATFORMS: Final[dict[str, Platform]] = {
    p.folder: p
    for p in (
        Platform("linux64", "x86_64-linux", "x86_64-linux-gnu.2.17", ".so"),
        Platform("aarch64-linux", "aarch64-linux", "aarch64-linux-gnu.2.17", ".so"),
        Platform("win64", "x86_64-windows", "x86_64-windows-gnu", ".dll"),
        Platform("darwin64", "x86_64-darwin", "x86_64-macos.10.15", ".dylib"),
        Platform("aarch64-darwin", "aarch64-darwin", "aarch64-macos.11.0", ".dylib"),
    )
}


class BuildError(ValueError):
    """A build that cannot be made, in one line."""


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


@dataclass(frozen=True)
class BuildOptions:
    """Choices of one build.

    Args:
        legs: number of legs, 2 to 64.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``), for FMI 2.0; in FMI 3.0
            the entries of a row are an array and both are alike.
        platforms: names (FMI 2.0.5 folders) of the binaries to include; empty for sources only.
        fmi: version of the standard, 2 or 3.

    Raises:
        BuildError: a value outside what is allowed.
    """

    legs: int = 4
    naming: str = "structured"
    platforms: tuple[str, ...] = tuple(PLATFORMS)
    fmi: int = 2

    def __post_init__(self) -> None:
        """Check the choices."""
        if not 2 <= self.legs <= MAX_LEGS:
            raise BuildError(f"legs = {self.legs} is not in 2 ... {MAX_LEGS}")
        if self.naming not in NAMINGS:
            raise BuildError(f"naming '{self.naming}' is not one of {', '.join(NAMINGS)}")
        if self.fmi not in FMI_VERSIONS:
            raise BuildError(f"fmi = {self.fmi} is not one of 2, 3")
        for name in self.platforms:
            if name not in PLATFORMS:
                raise BuildError(f"platform '{name}' is not one of {', '.join(PLATFORMS)}")
