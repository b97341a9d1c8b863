"""Figures 4, 5 and 6 with every controller in every cell, at the paper's size or any other.

    python -m research.evaluation --trials 100 --resume

``apnc study`` runs fewer seeds of the baselines, at some of the values. This runs all seeds of all
controllers at all values, 20 as in the paper, and says how sure each share and each median is.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

import typer
from typer import Option

import apnc
from apnc.cli.console import bar, say_file, writable
from apnc.cli.interrupt import STOP, Interrupted
from apnc.cli.main import main as run_app
from apnc.controllers import named_controller
from apnc.studies.registry import STUDIES
from apnc.studies.results import (
    STRICT,
    Result,
    cells_in,
    controllers_in,
    matching,
    successes,
    values,
)
from apnc.studies.statistics import median, rate
from apnc.studies.study import load
from apnc.studies.table import markdown

FIGURES: Final = {"mi": "Fig. 4", "rate": "Fig. 5", "terrain": "Fig. 6"}
"""Figure of the paper by study; each study has one axis."""

HEADS: Final = {"mi": "MI", "rate": "rate [Hz]", "roughness": "R"}
"""Head of the first column of a table by axis."""

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)


def axis_of(name: str) -> str:
    """Name of the one axis of a study."""
    (axis,) = load(STUDIES[name]).axes
    return axis


def table(name: str, results: Sequence[Result]) -> str:
    """A line per cell: gaits formed by the strict criterion, and the time to them, by controller.

    Shares have exact 95 % intervals, medians bootstrapped ones.
    """
    axis = axis_of(name)
    return markdown(
        {HEADS[axis]: f"{cell:g}"}
        | {named_controller(c).name: _told(results, c, axis, cell) for c in controllers_in(results)}
        for cell in cells_in(results, axis)
    )


def _told(results: Sequence[Result], controller: str, axis: str, cell: float) -> str:
    own = matching(results, controller=controller, **{axis: cell})
    time = median(values(own, STRICT)).text(1, "s")
    return f"{rate(successes(own))}, {time}"


@app.command(help="Figures 4, 5 and 6, all controllers in all cells.")
def evaluation(
    trials: Annotated[int, Option(help="Number of seeds per cell; the paper has 20.")] = 100,
    robot: Annotated[str | None, Option(help="Robot name or TOML file.")] = None,
    duration: Annotated[
        float | None, Option(help="Simulated time of a trial [s]. Default: that of the study.")
    ] = None,
    workers: Annotated[int | None, Option(help="Number of threads. Default: all cores.")] = None,
    output: Annotated[Path, Option(help="Folder; each figure has its own in it.")] = Path(
        "apnc-research-evaluation"
    ),
    resume: Annotated[bool, Option("--resume", help="Continue in the output folder.")] = False,
) -> None:
    """Run the three studies, and write a report and a table of each."""
    for name, figure in FIGURES.items():
        axis = axis_of(name)
        folder = writable(output / name)
        with bar(figure) as show:

            def progress(done: int, count: int, simulated: float, total: float) -> None:
                show(simulated, total, lambda x: f"{done} of {count} trials  {x:.1f}x real time")

            results = apnc.run_study(
                name,
                trials=trials,
                chosen={axis: load(STUDIES[name]).axes[axis]},
                robot=robot,
                duration=duration,
                workers=workers if workers is not None else os.cpu_count() or 1,
                output=folder,
                resume=resume,
                progress=progress,
                stop=STOP,
            )
        (folder / f"{name}-cells.md").write_text(table(name, results), encoding="utf-8")
        say_file(f"{figure}: {len(results)} trials; report", folder / "report.html")
        if STOP.asked:
            raise Interrupted("interrupted; --resume finishes it")


if __name__ == "__main__":
    run_app(program="python -m research.evaluation", load=lambda: app)
