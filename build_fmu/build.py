"""Builds an FMU: description, configuration, libraries, zip file. Finished builds are cached."""

from __future__ import annotations

import hashlib
import importlib.resources
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Final

import apnc_core
from build_fmu import sources, terminals
from build_fmu.cache import cache_folder, temporary_folder
from build_fmu.compile import NO_COMPILER, BuildProgress, compile_library, compiler_version
from build_fmu.controller import controller_model
from build_fmu.documentation import controller_documentation
from build_fmu.model import Model
from build_fmu.model_description import model_description
from build_fmu.model_description_fmi3 import build_description, model_description_fmi3
from build_fmu.options import BuildOptions
from build_fmu.package import zip_fmu
from build_fmu.platforms import MODEL, PLATFORMS, BuildError, host_platform, place, placed
from build_fmu.writing import write_atomically

__all__ = ["build_key", "cache_folder", "cached_fmu", "finished_fmu", "fmu_bytes", "host_fmu"]

READY: Final = Path(__file__).parent / "ready"
"""Folder of the FMUs that came with the package; each file is named by the key of its build."""

READY_LEGS: Final = (4, 6, 8)
"""Numbers of legs of those FMUs, which are those of the shipped robots."""


def fmu_bytes(
    options: BuildOptions,
    progress: BuildProgress = lambda platform: None,
    files: dict[str, bytes] | None = None,
) -> bytes:
    """Bytes of the controller's FMU, built without the cache.

    Args:
        options: what to build.
        progress: called with the platform that is compiled next.
        files: C sources by name instead of the shipped ones.

    Raises:
        BuildError: the compiler failed.
    """
    return built(
        controller_model(options),
        files or sources.collect(options.fmi),
        lambda guid: {"apnc_config.h": sources.config_header(options, guid)},
        controller_documentation(options),
        options.platforms,
        progress,
    )


def built(
    model: Model,
    files: dict[str, bytes],
    configured: Callable[[str], dict[str, bytes]],
    pages: dict[str, bytes],
    platforms: tuple[str, ...],
    progress: BuildProgress = lambda platform: None,
) -> bytes:
    """Bytes of the FMU of any model.

    Args:
        model: what the FMU describes.
        files: C sources and headers by name.
        configured: gives the configuration headers for a guid.
        pages: other files by their path in the FMU.
        platforms: names of the binaries to include.
        progress: called with the platform that is compiled next.

    Raises:
        BuildError: the compiler failed.
    """
    c_files = sources.c_files(files)
    # the guid changes with everything that the description and the binaries depend on
    described = _describe(model, c_files, "")
    guid = sources.guid_of(described, *files.values(), *configured("").values())
    files = files | configured(guid)
    content = {"modelDescription.xml": _describe(model, c_files, guid)}
    if model.fmi == 3:
        content["sources/buildDescription.xml"] = build_description(model, c_files)
        content[terminals.PATH] = terminals.terminals_and_icons(model)
    content |= {f"sources/{name}": text for name, text in files.items()}
    content |= pages
    with temporary_folder() as folder:
        for name, text in files.items():
            (Path(folder) / name).write_bytes(text)
        libraries = {}
        for name in platforms:
            progress(name)
            libraries[name] = compile_library(
                Path(folder), c_files, PLATFORMS[name], model.identifier
            )
    return zip_fmu(content | placed(libraries, model.fmi, model.identifier))


def _describe(model: Model, c_files: list[str], guid: str) -> bytes:
    if model.fmi == 3:
        return model_description_fmi3(model, guid)
    return model_description(model, c_files, guid)


def build_key(options: BuildOptions) -> str:
    """Key of a build, 16 digits: a hash of all it depends on but the compiler and FMI headers.

    Args:
        options: what to build.

    A ready FMU with this key was built with these options from the sources of this package.
    """
    parts = [
        repr(options).encode(),
        apnc_core.__version__.encode(),
        *_files_of("build_fmu"),
        *_files_of("apnc_core"),
        repr([PLATFORMS[name] for name in options.platforms]).encode(),
        *sources.own_files(options.fmi).values(),
    ]
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]


def _files_of(package: str) -> list[bytes]:
    """Contents of the Python files and templates of a package, on which a build depends."""
    root = importlib.resources.files(package)
    folders = [root, root.joinpath("templates")]
    entries = [e for f in folders if f.is_dir() for e in f.iterdir()]
    wanted = [e for e in entries if e.name.endswith((".py", ".j2", ".txt"))]
    return [e.read_bytes() for e in sorted(wanted, key=lambda e: e.name)]


def cached_fmu(options: BuildOptions, progress: BuildProgress = lambda platform: None) -> Path:
    """Path of an FMU that came with the package, lies in the cache or is built now.

    Args:
        options: what to build.
        progress: called with the platform that is compiled next, if anything is compiled.

    Raises:
        BuildError: the compiler failed, or it is needed and not installed.
        OSError: the cache folder cannot be written.
    """
    path = finished_fmu(options)
    if path is None:
        if options.platforms and not compiler_version():
            raise BuildError(_no_compiler())
        path = cached_path(build_key(options), MODEL)
        write_atomically(path, fmu_bytes(options, progress))
    return path


def finished_fmu(options: BuildOptions) -> Path | None:
    """Path of an FMU for which nothing has to be compiled, or None.

    Args:
        options: what the FMU is built with. It came with the package with these options, or for
            more platforms, or lies in the cache.

    Raises:
        OSError: the cache folder cannot be written.
    """
    key = build_key(options)
    ready = READY / f"{key}.fmu"
    if ready.is_file():
        return ready
    path = cached_path(key, MODEL)
    if not path.is_file():
        everywhere = _ready_everywhere(options)
        # alone, darwin64 is the library for Intel; the ready FMU has one file for both processors
        if not everywhere.is_file() or "darwin64" in options.platforms:
            return None
        write_atomically(path, _narrowed(everywhere, options))
    return path


def cached_path(key: str, model: str) -> Path:
    """Path of a built FMU in the cache.

    Args:
        key: of its build.
        model: name of the model.
    """
    return cache_folder() / f"{key}-{compiler_version() or 'none'}" / f"{model}.fmu"


def _ready_everywhere(options: BuildOptions) -> Path:
    """Path at which a ready FMU for all platforms would lie."""
    return READY / f"{build_key(replace(options, platforms=tuple(PLATFORMS)))}.fmu"


def _narrowed(fmu: Path, options: BuildOptions) -> bytes:
    """The FMU with the binaries of ``options`` alone, equal to what a build of them gives."""
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    libraries = {name: files[place(PLATFORMS[name], options.fmi)] for name in options.platforms}
    rest = {name: content for name, content in files.items() if not name.startswith("binaries/")}
    return zip_fmu(rest | placed(libraries, options.fmi))


def _no_compiler() -> str:
    ready = len(list(READY.glob("*.fmu")))
    *few, most = READY_LEGS
    return (
        f"this FMU is none of the {ready} that came with the package "
        f"({', '.join(map(str, few))} and {most} legs, FMI 2, defaults, for this machine), "
        f"or its sources were changed since, and {NO_COMPILER}"
    )


def host_fmu(legs: int = 4, fmi: int = 2) -> Path:
    """Path of an FMU with its defaults and a binary for this machine.

    Args:
        legs: number of legs.
        fmi: version of the standard, 2 or 3.

    Raises:
        BuildError: as ``cached_fmu``.
        OSError: the cache folder cannot be written.
    """
    host = host_platform()
    options = BuildOptions(legs=legs, platforms=(host,), fmi=fmi)
    everywhere = _ready_everywhere(options)
    # FMPy on ARM Linux would open the library for Intel that it holds
    if everywhere.is_file() and host != "aarch64-linux":
        return everywhere
    return cached_fmu(options)
