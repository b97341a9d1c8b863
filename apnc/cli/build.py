"""``apnc build``: the FMU as a file, for any tool."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Option

from apnc.cli.console import say, status, writable, writable_file


def build(
    output: Annotated[Path, Option(help="File to write.")] = Path("Apnc.fmu"),
    legs: Annotated[int, Option(help="Number of legs.")] = 4,
    naming: Annotated[
        str, Option(help="structured (leg[1].grf) or flat (leg1_grf).")
    ] = "structured",
    fmi: Annotated[int, Option(help="Version of the standard, 2 or 3.")] = 2,
    platform: Annotated[
        list[str] | None,
        Option(help="Folder name in FMI 2, such as win64; host or all; repeatable."),
    ] = None,
    preset: Annotated[str, Option(help="Parameters it starts with: lilibot or paper.")] = "lilibot",
    setting: Annotated[
        list[str] | None, Option("--set", help="NAME=VALUE it starts with; repeatable.")
    ] = None,
    params: Annotated[
        Path | None,
        Option("--params", "--parameters", help="summary.json, SSV, JSON or TOML file."),
    ] = None,
    memory: Annotated[Path | None, Option(help="Learned gait it starts with.")] = None,
    method: Annotated[str | None, Option(help="Controller it starts with.")] = None,
    enumerations: Annotated[
        str, Option(help="enumeration, or integer for tools without them.")
    ] = "enumeration",
    release: Annotated[
        Path | None, Option(help="Write the FMUs of a release into this folder instead.")
    ] = None,
) -> None:
    """Build the FMU."""
    if release:
        _release(release)
        return
    from apnc.loop.gait import read_gait
    from apnc.loop.parameters import read_parameters
    from apnc_core.settings import parse
    from build_fmu.build import cached_fmu, write_atomically
    from build_fmu.options import BuildOptions

    settings = read_parameters(params) if params else {}
    settings |= {"method": method} if method else {}
    settings |= dict(map(parse, setting or ()))
    options = BuildOptions(
        legs=legs,
        naming=naming,
        platforms=_platforms(platform or ["all"]),
        fmi=fmi,
        preset=preset,
        settings=settings,
        memory=read_gait(memory).phi if memory else (),
        enumerations=enumerations,
    )
    writable_file(output)
    with status("building") as shown:
        path = cached_fmu(options, lambda name: shown.update(f"compiling for {name}"))
        write_atomically(output, path.read_bytes())
    say(f"{output}: {output.stat().st_size / 1000:.0f} kB, {', '.join(options.platforms)}")


def _platforms(names: list[str]) -> tuple[str, ...]:
    from build_fmu.options import PLATFORMS, host_platform

    short = {"all": tuple(PLATFORMS), "host": ()}
    if "host" in names:
        short["host"] = (host_platform(),)
    return tuple(dict.fromkeys(p for name in names for p in short.get(name, (name,))))


def _release(folder: Path) -> None:
    from build_fmu.release import release

    writable(folder)
    with status("building") as shown:
        files = release(folder, lambda file, name: shown.update(f"{file}: compiling for {name}"))
    say(f"{folder}: {', '.join(path.name for path in files)}")
