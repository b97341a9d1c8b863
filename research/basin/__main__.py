"""``python -m research.basin``: where walks end that begin at other phases."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer
from typer import Option

from apnc.cli.console import bar, say, say_file, writable
from apnc.cli.interrupt import STOP, Interrupted
from apnc.cli.main import main as run_app
from apnc.studies.machine import commit
from research.basin.ends import counts, counts_table
from research.basin.runner import SECONDS, TABLE_FILE, grid_of, run

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)


@app.command(help="Walk from phases by chance and from every gait with a name.")
def basin(
    robot: Annotated[str, Option(help="Robot name or TOML file.")] = "lilibot",
    trials: Annotated[int, Option(help="Number of starts at phases by chance.")] = 1000,
    repeats: Annotated[int, Option(help="Number of starts at each gait with a name.")] = 20,
    mi: Annotated[str, Option(help="MI of the walks, separated by commas.")] = "0.08,0.15",
    duration: Annotated[float, Option(help="Simulated time of a walk [s].")] = SECONDS,
    workers: Annotated[int | None, Option(help="Number of processes. Default: all cores.")] = None,
    output: Annotated[Path, Option(help="Folder for the results.")] = Path("apnc-research-basin"),
    resume: Annotated[bool, Option("--resume", help="Continue in the output folder.")] = False,
) -> None:
    """Walk, and print the table."""
    for name, value in (("trials", trials), ("repeats", repeats)):
        if value < 0:
            raise ValueError(f"{name} = {value} is not at least 0")
    try:
        mis = [float(text) for text in mi.split(",")]
    except ValueError:
        raise ValueError(f"mi = {mi}: not numbers with commas between") from None
    grid = grid_of(robot, mis, trials, repeats, duration)
    with bar("basin") as show:

        def progress(done: int, total: int) -> None:
            show(done * duration, total * duration, lambda x: f"{done} of {total} walks")

        results = run(
            grid,
            writable(output),
            workers=workers if workers is not None else os.cpu_count() or 1,
            resume=resume,
            progress=progress,
            stop=STOP,
        )
    text = counts_table(counts(results))
    (output / "basin.md").write_text(f"- commit: {commit()}\n\n{text}", encoding="utf-8")
    say(text)
    say_file(f"{len(results)} walks; table", output / TABLE_FILE)
    if STOP.asked:
        raise Interrupted("interrupted; --resume finishes it")


if __name__ == "__main__":
    run_app(program="python -m research.basin", load=lambda: app)
