"""``apnc build``: the FMU as a file, for any tool."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Option

from apnc.cli.console import File, Text, Texts, say, status, writable


def build(
    output: Annotated[Path, Option(help="File to write.")] = Path("Apnc.fmu"),
    legs: Annotated[int, Option(help="Number of legs.")] = 4,
    naming: Annotated[str, Option(help="structured, flat: leg[1].grf, leg1_grf.")] = "structured",
    fmi: Annotated[int, Option(help="Version of the standard, 2 or 3.")] = 2,
    platform: Annotated[Texts, Option(help="As win64; host; all if omitted; repeatable.")] = None,
    preset: Annotated[str, Option(help="Parameters at the start: lilibot, paper.")] = "lilibot",
    setting: Annotated[Texts, Option("--set", help="NAME=VALUE at the start; repeatable.")] = None,
    params: Annotated[File, Option("--params", "--parameters", help="SSV, TOML, JSON.")] = None,
    memory: Annotated[File, Option(help="Learned gait at the start.")] = None,
    method: Annotated[Text, Option(help="Controller at the start.")] = None,
    enumerations: Annotated[str, Option(help="enumeration, integer.")] = "enumeration",
    release: Annotated[File, Option(help="Folder for all files of a release instead.")] = None,
) -> None:
    """Build the FMU."""
    from apnc.loop.gait import read_gait
    from apnc.loop.parameters import read_parameters
    from apnc_core.settings import parse
    from build_fmu.build import cached_fmu, write_atomically
    from build_fmu.options import PLATFORMS, BuildOptions, host_platform
    from build_fmu.release import release as build_release

    with status("building") as shown:
        if release:
            files = build_release(
                writable(release), lambda file, name: shown.update(f"{file}: compiling for {name}")
            )
            say(f"{release}: {', '.join(path.name for path in files)}")
            return
        short = {"all": PLATFORMS, "host": [host_platform()] if "host" in (platform or ()) else []}
        names = [name for word in platform or ["all"] for name in short.get(word, [word])]
        settings = read_parameters(params) if params else {}
        settings |= {"method": method} if method else {}
        settings |= dict(map(parse, setting or ()))
        options = BuildOptions(
            legs=legs,
            naming=naming,
            platforms=tuple(dict.fromkeys(names)),
            fmi=fmi,
            preset=preset,
            settings=settings,
            memory=read_gait(memory).phi if memory else (),
            enumerations=enumerations,
        )
        writable(output, file=True)
        path = cached_fmu(options, lambda name: shown.update(f"compiling for {name}"))
        write_atomically(output, path.read_bytes())
    say(f"{output}: {output.stat().st_size / 1000:.0f} kB, {', '.join(options.platforms)}")
