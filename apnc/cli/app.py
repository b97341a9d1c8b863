"""The commands of ``apnc``."""

from __future__ import annotations

from typing import Annotated

import typer

from apnc.cli import build, export_robot, gait, import_robot, info, study, system, tune, walk
from apnc_core import __version__

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # it would eat the [s] and [m] of the help texts
    help="Adaptive neural control for legged robots. Build the FMU, and walk a robot under it.",
)
app.command("walk")(walk.walk)
app.command("build")(build.build)
app.command("build-plant")(system.build_plant)
app.command("build-system")(system.build_system)
app.command("info")(info.info)
app.add_typer(gait.app, name="gait")
app.add_typer(study.app, name="study")
app.command("export-robot")(export_robot.export_robot)
app.command("import-robot")(import_robot.import_robot)
app.command("tune")(tune.tune)


@app.callback(invoke_without_command=True)
def _version(
    version: Annotated[bool, typer.Option("--version", help="Show the version.")] = False,
) -> None:
    if version:
        typer.echo(__version__)
        raise typer.Exit
