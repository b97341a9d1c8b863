"""``apnc build-plant`` and ``apnc build-system``: parts for models of a whole system."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

from typer import Context, Option

from apnc.cli import completion as complete
from apnc.cli.build import Enumerations, Fmi, Naming, Reals, platform_names
from apnc.cli.console import apart, compiling, file_option, given, say, status, writable
from apnc.controllers import CONTROLLERS

_CONTROLLERS = ", ".join(CONTROLLERS)


def build_plant(
    robot: Annotated[
        str, Option(help="Robot name or TOML file.", autocompletion=complete.robots)
    ] = "lilibot",
    output: Annotated[
        Path | None, file_option("File to write. Default: the robot's name, LilibotPlant.fmu.")
    ] = None,
    naming: Naming = "structured",
    fmi: Fmi = 2,
    platform: Annotated[
        list[str] | None,
        Option(
            help="Platform such as win64, or host. May be repeated. Default: all.",
            autocompletion=complete.platforms,
        ),
    ] = None,
    enumerations: Enumerations = "enumeration",
    reals: Reals = False,
) -> None:
    """Build the robot as an FMU. It is plain C and needs no Python where it runs."""
    from apnc.system.plant_fmu import PlantBuild, plant_fmu, plant_model
    from build_fmu.writing import write_atomically

    with status("building") as shown:
        apart({"--output": output}, given(robot=robot))
        wanted = PlantBuild(robot, naming, fmi, platform_names(platform), enumerations, reals)
        output = writable(output or Path(f"{plant_model(robot)}.fmu"), file=True)
        path = plant_fmu(wanted, compiling(shown, len(wanted.platforms)))
        write_atomically(output, path.read_bytes())
    say(f"{output}: {output.stat().st_size / 1000:.0f} kB, {', '.join(wanted.platforms)}")


def build_system(
    context: Context,
    output: Annotated[
        Path | None, file_option("Archive to write. Default: the robot's name, Lilibot.ssp.")
    ] = None,
    robot: Annotated[
        str, Option(help="Robot name or TOML file.", autocompletion=complete.robots)
    ] = "lilibot",
    naming: Naming = "structured",
    mi: Annotated[
        float | None,
        Option(help="Modulatory input at the start. Default: 0.08, or the robot's own."),
    ] = None,
    seed: Annotated[int, Option(help="Seed of noise, asymmetry and obstacles.")] = 0,
    condition: Annotated[
        str, Option(help="Condition, C1 to C4 or S1 to S3.", autocompletion=complete.conditions)
    ] = "C1",
    payload: Annotated[
        float, Option(help="Box on the trunk besides that of the condition [kg].")
    ] = 0,
    roughness: Annotated[
        float | None, Option(help="Roughness of the paper's obstacles [0 ... 1].")
    ] = None,
    slope: Annotated[float | None, Option(help="Rise of the ground along x [deg].")] = None,
    turn: Annotated[float, Option(help="Steering, -1 right ... 1 left.")] = 0.0,
    controller: Annotated[
        str, Option(help=f"Controller, one of {_CONTROLLERS}.", autocompletion=complete.controllers)
    ] = "apnc",
    preset: Annotated[str, Option(help="Parameters of robot, lilibot or paper.")] = "robot",
    rate: Annotated[
        float | None,
        Option(help="Update rate of the controller [Hz]. Default: 60.0, or the robot's own."),
    ] = None,
    setting: Annotated[
        list[str] | None,
        Option(
            "--set",
            help="NAME=VALUE of controller or robot, as servo.stiffness=20. May be repeated.",
        ),
    ] = None,
    gait: Annotated[Path | None, Option(help="File of a stored gait to start with.")] = None,
    duration: Annotated[float, Option(help="End of the default experiment [s].")] = 45.0,
    platform: Annotated[
        list[str] | None,
        Option(
            help="Platform such as win64, all or host. May be repeated. Default: host.",
            autocompletion=complete.platforms,
        ),
    ] = None,
) -> None:
    """Build a system of controller and robot: an SSP archive, and a folder for other tools."""
    from apnc.cli.walk import experiment_of
    from apnc.system.build import build_system as build
    from apnc.system.structure import plant_setting, system_name
    from apnc_plant.conditions import named_conditions

    with status("building"):
        apart({"--output": output}, given(robot=robot, gait=gait))
        numbers = dict(filter(None, map(plant_setting, setting or ())))
        own = [text for text in setting or () if plant_setting(text) is None]
        words = context.params | {
            "mi": None if mi is None else str(mi),
            "turn": str(turn),
            "setting": own,
        }
        experiment = experiment_of(words)
        if payload:
            named = named_conditions(condition, experiment.description)
            if hint := payload_hint(payload, experiment.description.mass):
                say(hint, error=True)
            loaded = replace(named, payload=named.payload + payload)
            experiment = replace(experiment, conditions=loaded)
        output = writable(output or Path(f"{system_name(robot)}.ssp"), file=True)
        folder = build(output, experiment, naming, platform_names(platform or ["host"]), numbers)
    say(f"{output}, and the same as a folder: {folder}/")


def payload_hint(payload: float, mass: float) -> str:
    """A line for a payload [kg] heavier than the robot's mass [kg], as a percentage reads."""
    if payload <= mass:
        return ""
    return f"--payload {payload:g} is in kg: {payload / mass:.1f} times the robot's {mass:.2f} kg"
