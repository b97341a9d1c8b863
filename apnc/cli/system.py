"""``apnc build-plant`` and ``apnc build-system``: parts for models of a whole system."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from apnc.cli.console import File, Texts, say, status, writable

_NAMING = "structured, flat: leg[1].grf, leg1_grf."


def build_plant(
    robot: Annotated[str, Option(help="Name or TOML file.")] = "lilibot",
    output: Annotated[File, Option(help="File to write; LilibotPlant.fmu if omitted.")] = None,
    naming: Annotated[str, Option(help=_NAMING)] = "structured",
) -> None:
    """Build the robot in Exudyn as an FMU; where it runs, this package must be installed."""
    from apnc.system.plant_fmu import plant_fmu, plant_model
    from build_fmu.cache import write_atomically

    with status("building"):
        output = writable(output or Path(f"{plant_model(robot)}.fmu"), file=True)
        write_atomically(output, plant_fmu(robot, naming))
    say(f"{output}: {output.stat().st_size / 1000:.0f} kB; runs in a Python that has this package")


def build_system(
    output: Annotated[File, Option(help="Archive to write; Lilibot.ssp if omitted.")] = None,
    robot: Annotated[str, Option(help="Name or TOML file.")] = "lilibot",
    naming: Annotated[str, Option(help=_NAMING)] = "structured",
    mi: Annotated[float, Option(help="Modulatory input at the start.")] = 0.08,
    seed: Annotated[int, Option(help="Of noise and asymmetry.")] = 0,
    condition: Annotated[str, Option(help="C1 to C4, S1 to S3.")] = "C1",
    method: Annotated[str, Option(help="Controller.")] = "apnc",
    preset: Annotated[str, Option(help="robot, lilibot, paper.")] = "robot",
    setting: Annotated[Texts, Option("--set", help="Parameter, NAME=VALUE; repeatable.")] = None,
    memory: Annotated[File, Option(help="Learned gait to start with.")] = None,
    duration: Annotated[float, Option(help="End of the default experiment [s].")] = 45.0,
    platform: Annotated[Texts, Option(help="Of the controller; this one if omitted.")] = None,
) -> None:
    """Build controller and robot, connected: an SSP archive, and a folder that OSP reads too."""
    from apnc.loop.experiment import Experiment
    from apnc.loop.gait import read_gait
    from apnc.system.build import build_system as build
    from apnc.system.structure import system_name
    from apnc_core.settings import parse

    with status("building"):
        settings: dict[str, Any] = dict(map(parse, setting or ()))
        experiment = Experiment(
            robot=robot, mi=mi, seed=seed, duration=duration, method=method, preset=preset,
            conditions=condition, settings=settings,
        )  # fmt: skip
        if memory:
            legs = tuple(leg.name for leg in experiment.description.legs)
            own = read_gait(memory).settings(legs) | settings
            experiment = Experiment(**{**experiment.changed(), "settings": own})
        output = writable(output or Path(f"{system_name(robot)}.ssp"), file=True)
        folder = build(output, experiment, naming, tuple(platform or ()))
    say(f"{output}, and unpacked with OspSystemStructure.xml: {folder}/")
