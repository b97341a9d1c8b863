"""The robot in C as a shared library that Python loads."""

from __future__ import annotations

import hashlib
import importlib.resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Final

from build_fmu import compile as compiler
from build_fmu.cache import cache_folder, temporary_folder
from build_fmu.compile import BuildProgress
from build_fmu.platforms import PLATFORMS, BuildError, Platform, host_platform
from build_fmu.writing import write_atomically

READY: Final = Path(__file__).parent / "ready"
"""Folder of the libraries that came with the package; each file is named by its key."""

NAME: Final = "apnc_plant"

_FOLDERS: Final = ("plant", "loop")
"""Folders of ``fmu_src``: the robot, and closed loops of robot and controller."""

_FLAGS: Final = ("-fvisibility=default",)
"""Further flags: Python looks up the functions by name, which an FMU hides."""


def headers() -> list[str]:
    """Text of ``plant.h`` and ``loop.h``, which declare the functions of the library."""
    paths = [_root().joinpath(name).joinpath(f"{name}.h") for name in _FOLDERS]
    return [path.read_text(encoding="utf-8") for path in paths]


def sources() -> dict[str, bytes]:
    """C files and headers by name."""
    entries = [entry for name in _FOLDERS for entry in _root().joinpath(name).iterdir()]
    files = {entry.name: entry.read_bytes() for entry in entries if _is_c(entry.name)}
    return dict(sorted(files.items()))


def _root() -> Traversable:
    return importlib.resources.files("fmu_src")


def _is_c(name: str) -> bool:
    return name.endswith((".c", ".h"))


def library_name(platform: Platform) -> str:
    """File name of the library for a platform: a hash of its sources, flags and platform."""
    parts = [repr((compiler.FLAGS, _FLAGS, platform)).encode()]
    for name, content in sources().items():
        parts += [name.encode(), content]
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16] + platform.suffix


def library_path(
    platform: str | None = None, progress: BuildProgress = lambda platform: None
) -> Path:
    """Path of a library that came with the package, lies in the cache or is built now.

    Args:
        platform: folder name of a platform; this machine's if omitted.
        progress: called with the platform if anything is compiled.

    Raises:
        BuildError: no such platform, the compiler failed, or it is needed and not installed.
        OSError: the cache folder cannot be written.
    """
    target = PLATFORMS[platform or host_platform()]
    name = library_name(target)
    ready = READY / name
    if ready.is_file():
        return ready
    version = compiler.compiler_version()
    path = cache_folder() / f"{ready.stem}-{version}" / f"{NAME}{target.suffix}"
    if not path.is_file():
        if not version:
            raise BuildError(
                "the package brings no library of the robot for this machine, or its sources were "
                f"changed since, and {compiler.NO_COMPILER}"
            )
        progress(target.folder)
        write_atomically(path, _built(target))
    return path


def _built(platform: Platform) -> bytes:
    files = sources()
    with temporary_folder() as folder:
        for name, content in files.items():
            (Path(folder) / name).write_bytes(content)
        c_files = [name for name in files if name.endswith(".c")]
        return compiler.compile_library(Path(folder), c_files, platform, NAME, _FLAGS)
