"""Build an FMU: describe, configure, compile, package; with a cache of finished builds."""

from __future__ import annotations

import hashlib
import importlib.metadata
import importlib.resources
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import platformdirs

import apnc_core
from build_fmu import sources
from build_fmu.compile import compile_library
from build_fmu.documentation import documentation
from build_fmu.model_description import model_description
from build_fmu.model_description_fmi3 import build_description, model_description_fmi3
from build_fmu.options import MODEL, PLATFORMS, BuildOptions, host_platform
from build_fmu.package import zip_fmu

Progress = Callable[[str], None]


def fmu_bytes(
    options: BuildOptions,
    progress: Progress = lambda platform: None,
    files: dict[str, bytes] | None = None,
) -> bytes:
    """The FMU as bytes, built anew.

    Args:
        options: what to build.
        progress: called with the platform that is compiled next.
        files: C sources by name instead of the shipped ones.

    Raises:
        BuildError: the compiler failed.
    """
    files = files or sources.collect(options.fmi)
    c_files = sources.c_files(files)
    # the guid stands for everything that the description and the binaries are made from
    guid = sources.guid_of(_describe(options, c_files, ""), *files.values())
    files = files | {"apnc_config.h": sources.config_header(options, guid)}
    content = {"modelDescription.xml": _describe(options, c_files, guid)}
    if options.fmi == 3:
        content["sources/buildDescription.xml"] = build_description(c_files)
    content |= {f"sources/{name}": text for name, text in files.items()}
    content |= documentation(options)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (Path(folder) / name).write_bytes(text)
        for name in options.platforms:
            progress(name)
            platform = PLATFORMS[name]
            library = compile_library(Path(folder), c_files, platform)
            content[f"binaries/{platform.folder_for(options.fmi)}/{MODEL}{platform.suffix}"] = (
                library
            )
    return zip_fmu(content)


def _describe(options: BuildOptions, c_files: list[str], guid: str) -> bytes:
    if options.fmi == 3:
        return model_description_fmi3(options, guid)
    return model_description(options, c_files, guid)


def cache_folder() -> Path:
    """Where finished builds are kept; ``APNC_CACHE`` overrides the user's cache folder."""
    return Path(os.environ.get("APNC_CACHE") or platformdirs.user_cache_dir("apnc"))


def _cache_key(options: BuildOptions) -> str:
    parts = [
        repr(options).encode(),
        apnc_core.__version__.encode(),
        importlib.metadata.version("ziglang").encode(),
        *_files_of("build_fmu"),
        *_files_of("apnc_core"),
        repr([PLATFORMS[name] for name in options.platforms]).encode(),
        _describe(options, [], ""),
        *sources.collect(options.fmi).values(),
    ]
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]


def _files_of(package: str) -> list[bytes]:
    """Python files and templates of a package: what a build depends on beside its options."""
    root = importlib.resources.files(package)
    folders = [root, root.joinpath("templates")]
    entries = [e for f in folders if f.is_dir() for e in f.iterdir()]
    wanted = [e for e in entries if e.name.endswith((".py", ".j2", ".txt"))]
    return [e.read_bytes() for e in sorted(wanted, key=lambda e: e.name)]


def cached_fmu(options: BuildOptions, progress: Progress = lambda platform: None) -> Path:
    """Path of the FMU in the cache, built if it is not there yet.

    Args:
        options: what to build.
        progress: called with the platform that is compiled next, if anything is compiled.

    Raises:
        BuildError: the compiler failed.
        OSError: the cache folder cannot be written.
    """
    path = cache_folder() / _cache_key(options) / f"{MODEL}.fmu"
    if not path.is_file():
        write_atomically(path, fmu_bytes(options, progress))
    return path


def host_fmu(legs: int = 4, fmi: int = 2) -> Path:
    """Path of the cached FMU with the binary of this machine only."""
    return cached_fmu(BuildOptions(legs=legs, platforms=(host_platform(),), fmi=fmi))


def write_atomically(path: Path, content: bytes) -> None:
    """Write so that a reader, or a second build, never sees half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    part.write_bytes(content)
    part.replace(path)
