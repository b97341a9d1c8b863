"""Build hook: the wheel carries the ready FMU and the robot in C: a walk needs no compiler.

``APNC_WHEEL_PLATFORMS`` names the platforms of its binaries: ``host`` (the default, fast), ``all``
(a release), or names of ``build_fmu.platforms`` with commas between them.
"""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

WHEEL_TAGS = {
    "linux64": "linux_x86_64",
    "aarch64-linux": "linux_aarch64",
    "win64": "win_amd64",
    "darwin64": "macosx_10_15_x86_64",
    "aarch64-darwin": "macosx_11_0_arm64",
}


class ReadyBinaries(BuildHookInterface[Any]):
    """Builds the FMUs of ``READY_LEGS``, and the library of the robot for every platform, into the
    wheel or into the tree of an editable install."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build and add them; set the wheel's tag to where they run."""
        sys.path.insert(0, self.root)
        from build_fmu.build import READY, READY_LEGS, cached_fmu
        from build_fmu.library import library_name, library_path
        from build_fmu.options import BuildOptions
        from build_fmu.platforms import PLATFORMS

        def told(platform: str) -> None:
            self.app.display_info(f"compiling for {platform}")

        platforms = _platforms(os.environ.get("APNC_WHEEL_PLATFORMS", "host"))
        built = []
        for legs in READY_LEGS if platforms else ():
            path = cached_fmu(BuildOptions(legs=legs, platforms=platforms), told)
            name = path.name if path.parent == READY else f"{path.parent.name[:16]}.fmu"
            built.append((path, name))
        for platform in platforms:
            path = library_path(platform, told)
            built.append((path, library_name(PLATFORMS[platform])))
        if version == "editable":
            _put_into_the_tree(READY, built)
            return
        for path, name in built:
            build_data["force_include"][str(path)] = f"build_fmu/ready/{name}"
        build_data["tag"] = wheel_tag(platforms)
        build_data["pure_python"] = build_data["tag"].endswith("-any")


def wheel_tag(platforms: tuple[str, ...]) -> str:
    """Tag of a wheel whose FMUs have binaries for ``platforms``."""
    everywhere = not platforms or set(platforms) == set(WHEEL_TAGS)
    return f"py3-none-{'any' if everywhere else '.'.join(WHEEL_TAGS[p] for p in platforms)}"


def _platforms(wanted: str) -> tuple[str, ...]:
    from build_fmu.platforms import PLATFORMS, BuildError, host_platform

    if wanted == "all":
        return tuple(PLATFORMS)
    if wanted != "host":
        return tuple(wanted.split(","))
    try:
        return (host_platform(),)
    except BuildError:  # the package installs, and says so when an FMU is asked for
        return ()


def _put_into_the_tree(folder: Path, built: list[tuple[Path, str]]) -> None:
    folder.mkdir(exist_ok=True)
    for old in folder.iterdir():
        if old.name not in {name for _, name in built}:
            old.unlink()
    for path, name in built:
        if path.parent != folder:
            shutil.copyfile(path, folder / name)
