"""``apnc build-plant`` and ``apnc build-system``: parts for models of a whole system."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

from typer import Context, Option

from apnc.cli.console import say, status, writable
from apnc.controllers import CONTROLLERS

_CONTROLLERS = ", ".join(CONTROLLERS)
_NAMING = "structured, flat: leg[1].grf, leg1_grf."


def build_plant(
    robot: Annotated[str, Option(help="Name or TOML file.")] = "lilibot",
    output: Annotated[
        Path | None, Option(help="File to write; LilibotPlant.fmu if omitted.")
    ] = None,
    naming: Annotated[str, Option(help=_NAMING)] = "structured",
    fmi: Annotated[int, Option(help="Version of the standard, 2 or 3.")] = 2,
    platform: Annotated[
        list[str] | None, Option(help="As win64; host; all if omitted; repeatable.")
    ] = None,
    enumerations: Annotated[str, Option(help="enumeration, integer.")] = "enumeration",
    reals: Annotated[bool, Option("--reals", help="Every variable as a Real.")] = False,
) -> None:
    """Build the robot as an FMU, in C: it needs no Python where it runs."""
    from apnc.cli.build import platform_names
    from apnc.system.plant_fmu import PlantBuild, plant_fmu, plant_model
    from build_fmu.writing import write_atomically

    with status("building") as shown:
        wanted = PlantBuild(robot, naming, fmi, platform_names(platform), enumerations, reals)
        output = writable(output or Path(f"{plant_model(robot)}.fmu"), file=True)
        path = plant_fmu(wanted, lambda name: shown.update(f"compiling for {name}"))
        write_atomically(output, path.read_bytes())
    say(f"{output}: {output.stat().st_size / 1000:.0f} kB, {', '.join(wanted.platforms)}")


def build_system(
    context: Context,
    output: Annotated[Path | None, Option(help="Archive to write; Lilibot.ssp if omitted.")] = None,
    robot: Annotated[str, Option(help="Name or TOML file.")] = "lilibot",
    naming: Annotated[str, Option(help=_NAMING)] = "structured",
    mi: Annotated[float, Option(help="Modulatory input at the start.")] = 0.08,
    seed: Annotated[int, Option(help="Of noise, asymmetry and obstacles.")] = 0,
    condition: Annotated[str, Option(help="C1 to C4, S1 to S3.")] = "C1",
    payload: Annotated[float, Option(help="Box on the trunk, on top of the condition's [kg].")] = 0,
    roughness: Annotated[float | None, Option(help="Of the paper's obstacles [0 ... 1].")] = None,
    slope: Annotated[float | None, Option(help="Rise of the ground along x [deg].")] = None,
    turn: Annotated[float, Option(help="-1 right ... 1 left.")] = 0.0,
    controller: Annotated[str, Option(help=f"{_CONTROLLERS}.")] = "apnc",
    preset: Annotated[str, Option(help="robot, lilibot, paper.")] = "robot",
    rate: Annotated[float, Option(help="Update rate [Hz].")] = 60.0,
    setting: Annotated[
        list[str] | None, Option("--set", help="NAME=VALUE; servo.stiffness=20 too.")
    ] = None,
    gait: Annotated[Path | None, Option(help="Stored gait to start with.")] = None,
    duration: Annotated[float, Option(help="End of the default experiment [s].")] = 45.0,
    platform: Annotated[list[str] | None, Option(help="As for build; this one if omitted.")] = None,
) -> None:
    """Build controller and robot, connected: an SSP archive, and a folder for other tools."""
    from apnc.cli.build import platform_names
    from apnc.cli.walk import experiment_of
    from apnc.system.build import build_system as build
    from apnc.system.structure import plant_setting, system_name
    from apnc_plant.conditions import named_conditions

    with status("building"):
        numbers = dict(filter(None, map(plant_setting, setting or ())))
        own = [text for text in setting or () if plant_setting(text) is None]
        words = context.params | {"mi": str(mi), "turn": str(turn), "setting": own}
        experiment = experiment_of(words)
        if payload:
            named = named_conditions(condition)
            loaded = replace(named, payload=named.payload + payload)
            experiment = replace(experiment, conditions=loaded)
        output = writable(output or Path(f"{system_name(robot)}.ssp"), file=True)
        folder = build(output, experiment, naming, platform_names(platform or ["host"]), numbers)
    say(f"{output}, and the same as a folder: {folder}/")
