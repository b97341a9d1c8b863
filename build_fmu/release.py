"""Ready-made FMUs of a release, for people without Python."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Final

import apnc_core
from apnc_core.legs import leg_names
from build_fmu.build import READY_LEGS, cached_fmu
from build_fmu.options import BuildOptions
from build_fmu.platforms import PLATFORMS
from build_fmu.writing import write_atomically

VARIANTS: Final[tuple[tuple[str, BuildOptions, str], ...]] = tuple(
    (f"Apnc_{legs}legs_{kind}.fmu", BuildOptions(legs=legs, **choice), text)
    for legs in READY_LEGS
    for kind, choice, text in (
        ("fmi2", {}, "FMI 2.0 co-simulation, names like `leg[1].grf`"),
        ("fmi2_flat", {"naming": "flat"}, "FMI 2.0 co-simulation, names like `leg1_grf`"),
        ("fmi3", {"fmi": 3}, "FMI 3.0 co-simulation, the legs as arrays"),
    )
)


def release(
    folder: Path,
    progress: Callable[[str, str], None] = lambda file, platform: None,
    platforms: tuple[str, ...] = tuple(PLATFORMS),
) -> list[Path]:
    """Write the FMUs of a release, SHA256SUMS and index.md, which says what is in each.

    Args:
        folder: where to write; made if it is not there.
        progress: called with the file and the platform that is compiled next.
        platforms: names of the binaries to include.

    Returns:
        The files written.

    Raises:
        BuildError: the compiler failed, or it is needed and not installed.
        OSError: a file cannot be written.
    """
    files: dict[str, bytes] = {}
    for name, options, _ in VARIANTS:
        told = partial(progress, name)
        files[name] = cached_fmu(replace(options, platforms=platforms), told).read_bytes()
    files["index.md"] = _index(files, platforms).encode()
    sums = (f"{hashlib.sha256(content).hexdigest()}  {name}\n" for name, content in files.items())
    files["SHA256SUMS"] = "".join(sums).encode()
    for name, content in files.items():
        write_atomically(folder / name, content)
    return [folder / name for name in files]


def _index(files: dict[str, bytes], platforms: tuple[str, ...]) -> str:
    table = "\n".join(
        f"| `{name}` | {', '.join(leg_names(options.legs))} | {text} "
        f"| {len(files[name]) / 1000:.0f} kB |"
        for name, options, text in VARIANTS
    )
    return f"""# APNC {apnc_core.__version__}: ready-made FMUs

The adaptive neural controller of a legged robot. The files need neither Python nor any other
software. Take the one for the legs of your robot and for the version of FMI that your tool reads.
Flat names are for tools that cannot read brackets in names or turn them into buses.

| file | legs | what it is | size |
|---|---|---|---|
{table}

Each holds binaries for {", ".join(platforms)} (glibc 2.17, Windows 10,
macOS 10.15 and 11, or newer), its C sources, `documentation/index.html` on every variable, and the
FMI 2.0 ones an experiment to check an import with. The defaults are those of the quadruped
Lilibot: set `robot_weight` [N] first.
`sha256sum -c SHA256SUMS` checks the files.
"""
