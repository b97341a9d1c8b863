"""``apnc build``: the FMU as a file, for any tool."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from typer import Option

from apnc.cli import completion as complete
from apnc.cli.console import apart, compiling, file_option, given, say, status, writable
from apnc.controllers import CONTROLLERS, named_controller

if TYPE_CHECKING:
    from apnc_core.settings import SettingLike
    from build_fmu.options import BuildOptions

_CONTROLLERS: Final = ", ".join(CONTROLLERS)


Naming = Annotated[
    str,
    Option(
        help="Names of variables: structured (leg[1].grf) or flat (leg1_grf).",
        autocompletion=complete.one_of("structured", "flat"),
    ),
]
Fmi = Annotated[
    int,
    Option(help="Version of the FMI standard, 2 or 3.", autocompletion=complete.one_of("2", "3")),
]
Enumerations = Annotated[
    str,
    Option(
        help="How enumerations are declared: enumeration or integer.",
        autocompletion=complete.one_of("enumeration", "integer"),
    ),
]
Reals = Annotated[bool, Option("--reals", help="Declare every variable as a Real.")]


def build(
    output: Annotated[Path, file_option("File to write.")] = Path("Apnc.fmu"),
    legs: Annotated[
        int | None, Option(help="Number of legs. Default: those of the robot, or 4.")
    ] = None,
    robot: Annotated[
        str | None,
        Option(
            help="Robot name or TOML file. Default: the shipped robot with --legs legs.",
            autocompletion=complete.robots,
        ),
    ] = None,
    naming: Naming = "structured",
    fmi: Fmi = 2,
    platform: Annotated[
        list[str] | None,
        Option(
            help="Platform such as win64, or host. May be repeated. Default: all; without the "
            "compiler, those of the FMU that came with the package.",
            autocompletion=complete.platforms,
        ),
    ] = None,
    preset: Annotated[
        str,
        Option(help="Start values of robot, lilibot or paper.", autocompletion=complete.presets),
    ] = "robot",
    setting: Annotated[
        list[str] | None,
        Option(
            "--set",
            help="Start value NAME=VALUE of a parameter. May be repeated.",
            autocompletion=complete.settings,
        ),
    ] = None,
    params: Annotated[
        Path | None,
        Option(
            "--params",
            "--parameters",
            help="File of start values: summary.json, SSV, JSON or TOML.",
        ),
    ] = None,
    gait: Annotated[Path | None, Option(help="File of a stored gait to start with.")] = None,
    controller: Annotated[
        str | None,
        Option(
            help=f"Controller to start with, one of {_CONTROLLERS}.",
            autocompletion=complete.controllers,
        ),
    ] = None,
    enumerations: Enumerations = "enumeration",
    reals: Reals = False,
    release: Annotated[
        Path | None, Option(help="Folder to write all files of a release to, in place of one FMU.")
    ] = None,
) -> None:
    """Build the FMU of the controller."""
    from apnc.loop.experiment import OWN_PRESET
    from apnc.loop.gait import read_gait
    from apnc.loop.parameters import read_parameters
    from apnc_core.settings import parse
    from build_fmu.build import cached_fmu, finished_fmu
    from build_fmu.compile import INSTALL_COMPILER, compiler_version
    from build_fmu.options import BuildOptions, host_platform
    from build_fmu.release import release as build_release
    from build_fmu.writing import write_atomically

    came_with_the_package = False
    with status("building") as shown:
        if release:
            files = build_release(
                writable(release), lambda file, name: shown.update(f"{file}: compiling for {name}")
            )
            say(f"{release}: {', '.join(path.name for path in files)}")
            return
        apart({"--output": output}, given(robot=robot, params=params, gait=gait))
        names, settings = _of_robot(robot, legs, own=preset == OWN_PRESET)
        if controller:
            settings |= named_controller(controller).settings
        settings |= read_parameters(params, controller) if params else {}
        if controller:
            settings |= {"method": named_controller(controller).method}
        settings |= dict(map(parse, setting or ()))
        options = BuildOptions(
            legs=legs or len(names),
            naming=naming,
            platforms=platform_names(platform),
            fmi=fmi,
            preset="lilibot" if preset == OWN_PRESET else preset,
            settings=settings,
            gait=read_gait(gait).settings(names)["phi_stored"] if gait else (),
            enumerations=enumerations,
            reals=reals,
        )
        writable(output, file=True)
        wished = ""
        if platform is None and (own := _without_compiler(options)):
            options, came_with_the_package = own, True
        elif (robot, setting, params, gait, controller) == (None,) * 5 and settings:
            # the ready FMU of these legs has the defaults, and a robot has start values of its own
            plain = replace(options, settings={}, platforms=(host_platform(),))
            if platform is None and not compiler_version() and finished_fmu(plain):
                options, came_with_the_package, wished = plain, True, _told(settings)
        path = cached_fmu(options, compiling(shown, len(options.platforms)))
        write_atomically(output, path.read_bytes())
    say(f"{output}: {output.stat().st_size / 1000:.0f} kB, {', '.join(options.platforms)}")
    if robot and (words := _mi_of(robot)):
        say(words)
    if wished:
        say(
            "Its start values are the defaults, Lilibot's. "
            f"The shipped robot of {legs} legs walks with {wished}"
        )
    if came_with_the_package:
        say(
            "It came with the package, for this machine. "
            f"Other platforms, legs and start values need the C compiler: {INSTALL_COMPILER}"
        )


def _told(settings: Mapping[str, SettingLike]) -> str:
    return ", ".join(f"{name}={value:.4g}" for name, value in sorted(settings.items()))


def _without_compiler(options: BuildOptions) -> BuildOptions | None:
    """The same FMU for this machine alone, if that is all there is without the compiler."""
    from build_fmu.build import finished_fmu
    from build_fmu.compile import compiler_version
    from build_fmu.options import host_platform

    if compiler_version() or finished_fmu(options):
        return None
    here = replace(options, platforms=(host_platform(),))
    return here if finished_fmu(here) else None


def platform_names(words: list[str] | None) -> tuple[str, ...]:
    """Names of platforms, with ``all`` and ``host`` resolved. No word means all."""
    from build_fmu.options import PLATFORMS, host_platform

    short = {"all": PLATFORMS, "host": [host_platform()] if "host" in (words or ()) else []}
    names = [name for word in words or ["all"] for name in short.get(word, [word])]
    return tuple(dict.fromkeys(names))


def _mi_of(name: str) -> str:
    """At which MI a robot walks, for who connects the input; empty if its file does not say it."""
    from apnc.loop.of_robot import own_mi
    from apnc_plant.robot import load_robot

    robot = load_robot(name)
    if robot.mi is None and robot.mi_range is None:
        return ""
    span = "" if robot.mi_range is None else " ({:g} to {:g})".format(*robot.mi_range)
    return f"MI is an input, 0.08 until it is set; this robot walks at {own_mi(robot):g}{span}"


def _of_robot(
    name: str | None, legs: int | None, *, own: bool
) -> tuple[tuple[str, ...], dict[str, SettingLike]]:
    """Names of the legs and start values of a robot: weight, update rate and its own preset.

    Args:
        name: of the robot, or None for the shipped one with ``legs`` legs.
        legs: number of legs, or None for that of the robot.
        own: whether the preset of the robot is taken.
    """
    from apnc_core.legs import leg_names
    from apnc_core.schema import MAX_LEGS
    from apnc_core.variables import variable_named
    from apnc_plant.robot import ROBOTS, load_robot

    if name is None:
        legs = 4 if legs is None else legs
        shipped = (load_robot(path.stem) for path in sorted(ROBOTS.glob("*.toml")))
        robot = next((each for each in shipped if len(each.legs) == legs), None)
        if robot is None:
            return leg_names(legs) if 2 <= legs <= MAX_LEGS else (), {}
    else:
        robot = load_robot(name)
        if legs not in (None, len(robot.legs)):
            raise ValueError(f"legs = {legs}: robot '{robot.name}' has {len(robot.legs)}")
    settings: dict[str, SettingLike] = dict(robot.controller) if own else {}
    usual = variable_named("robot_weight").start
    if usual is None or not math.isclose(robot.weight, usual):
        settings["robot_weight"] = robot.weight
    if robot.rate is not None:
        settings["Ts"] = 1.0 / robot.rate
    return tuple(leg.name for leg in robot.legs), settings
