"""The model's own studies on the command line: ``contact``, ``formation`` and ``states``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from apnc_studies import contact_study
from apnc_studies.console import StopRequest, err, out
from apnc_studies.formation_study import MI_VALUES, run_formation
from apnc_studies.memory_study import run_memory
from apnc_studies.sensitivity_study import CHANGES, run_sensitivity
from apnc_studies.trial_table import Execution

study = typer.Typer(no_args_is_help=True, help="Run a study: CSV, table and picture.")

INTERRUPTED = 130

Trials = Annotated[int, typer.Option(help="Seeds per cell of the grid.")]
Workers = Annotated[int, typer.Option(help="Processes.")]
Output = Annotated[Path | None, typer.Option(help="Folder for the results.")]
Resume = Annotated[bool, typer.Option("--resume", help="Keep the trials finished before.")]


@contextmanager
def _bar(label: str) -> Iterator[Callable[[float, float], None]]:
    """Progress bar with elapsed and remaining time; yields what to call with done and total."""
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        console=err,
        refresh_per_second=4,
    )
    task = bar.add_task(label, total=None)

    def update(done: float, total: float) -> None:
        if not bar.live.is_started:  # not before the first trial: until then mistakes may show
            bar.start()
        bar.update(task, completed=done, total=total)

    try:
        yield update
    finally:
        if bar.live.is_started:
            bar.stop()


def _folder(output: Path | None, name: str) -> Path:
    folder = output or Path(f"apnc-{name}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(f"output folder {folder} cannot be written: {error.strerror}") from None
    return folder


def _finish(table: Path, text: str, stop: StopRequest) -> None:
    out.print(text, highlight=False, markup=False, soft_wrap=True)
    out.print(f"results: {table.parent}", highlight=False, soft_wrap=True)
    if stop.asked:
        err.print(f"interrupted; --resume continues in {table.parent}", highlight=False)
        raise typer.Exit(INTERRUPTED)


@study.command("formation")
def formation_command(
    trials: Trials = 20,
    methods: Annotated[str, typer.Option(help="Controllers, comma separated.")] = "apnc,apc",
    mi: Annotated[
        list[float] | None, typer.Option(help="Modulatory input; repeatable. All 13 if omitted.")
    ] = None,
    duration: Annotated[float, typer.Option(help="Simulated time of a trial [s].")] = 45.0,
    workers: Workers = 2,
    output: Output = None,
    resume: Resume = False,
) -> None:
    """Convergence of the gait over MI on flat ground (Fig. 4)."""
    folder, stop = _folder(output, "formation"), StopRequest()
    with stop.listening(), _bar("formation") as progress:
        table = run_formation(
            folder,
            trials,
            tuple(mi or MI_VALUES),
            tuple(name.strip() for name in methods.split(",")),
            duration,
            Execution(workers, resume, progress, stop),
        )
    _finish(table, (folder / "formation.md").read_text(encoding="utf-8"), stop)


@study.command("states")
def states_command(
    trials: Trials = 20, workers: Workers = 2, output: Output = None, resume: Resume = False
) -> None:
    """States S1 to S3 in detail, with a picture of one run (Fig. 9-12)."""
    folder, stop = _folder(output, "states"), StopRequest()
    with stop.listening(), _bar("states") as progress:
        table = run_memory(folder, trials, Execution(workers, resume, progress, stop))
    _finish(table, (folder / "memory.md").read_text(encoding="utf-8"), stop)


@study.command("sensitivity")
def sensitivity_command(
    trials: Trials = 3,
    change: Annotated[
        list[str] | None, typer.Option(help="What is changed; repeatable. All if omitted.")
    ] = None,
    duration: Annotated[float, typer.Option(help="Simulated time of a trial [s].")] = 45.0,
    workers: Workers = 2,
    output: Output = None,
    resume: Resume = False,
) -> None:
    """What a change of one number of the robot does to the gait."""
    folder, stop = _folder(output, "sensitivity"), StopRequest()
    with stop.listening(), _bar("sensitivity") as progress:
        execution = Execution(workers, resume, progress, stop)
        table = run_sensitivity(folder, trials, change or tuple(CHANGES), duration, execution)
    _finish(table, (folder / "sensitivity.md").read_text(encoding="utf-8"), stop)


@study.command("contact")
def contact_command(output: Output = None) -> None:
    """Step-size study of the ground contact."""
    folder = _folder(output, "contact")
    with _bar("contact") as progress:
        contact_study.run(folder, lambda share: progress(round(100.0 * share), 100.0))
    out.print(f"results: {folder}", highlight=False, soft_wrap=True)
