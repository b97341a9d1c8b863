"""``apnc gait``: stored gaits as files."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

import apnc
from apnc.cli import completion as complete
from apnc.cli.console import apart, file_path, say, writable
from apnc.report import RUN_FILES

if TYPE_CHECKING:
    from apnc.loop.gait import Gait

FORMATS: Final = ("json", "ssv")

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="Save and show stored gaits.")


@app.command("save")
def save(
    run: Annotated[Path, typer.Argument(help="Output folder of apnc walk.")],
    file: Annotated[Path, typer.Argument(help="Gait file to write.", parser=file_path)],
    form: Annotated[
        str,
        typer.Option(
            "--format",
            help="Format of the file: json for apnc walk, or ssv for tools of SSP.",
            autocompletion=complete.one_of("json", "ssv"),
        ),
    ] = "json",
) -> None:
    """Write the gait that the couplings hold at the end of a walk."""
    if form not in FORMATS:
        raise ValueError(f"format '{form}' is not one of {', '.join(FORMATS)}")
    apart({"file": file}, {"the run": [run / name for name in RUN_FILES]})
    gait = apnc.gait_of_run(run)
    writable(file, file=True)
    if form == "ssv":
        from build_fmu.ssv import write_ssv

        write_ssv(gait.settings(gait.legs), file)
    else:
        apnc.write_gait(gait, file)
    say(f"{file}: {_in_words(gait)}")


@app.command("show")
def show(file: Annotated[Path, typer.Argument(help="Gait file.")]) -> None:
    """Show a stored gait."""
    say(_in_words(apnc.read_gait(file)))


def _in_words(gait: Gait) -> str:
    first, *others = gait.legs
    pairs = zip(others, gait.phi, strict=True)
    return f"phase against {first}: " + ", ".join(f"{leg} {phi:.2f} rad" for leg, phi in pairs)
