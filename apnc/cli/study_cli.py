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

from apnc.cli.console import StopRequest, err, out
from apnc.studies import contact_study
from apnc.studies.formation_study import MI_VALUES, run_formation
from apnc.studies.memory_study import run_memory
from apnc.studies.sensitivity_study import CHANGES, run_sensitivity
from apnc.studies.trial_table import Execution

study = typer.Typer(no_args_is_help=True, help="Run a study: CSV, table and picture.")

INTERRUPTED = 130

Trials = Annotated[int, typer.Option(help="Seeds per cell of the grid.")]
Duration = Annotated[float, typer.Option(help="Simulated time of a trial [s].")]
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


def _run(
    name: str,
    output: Path | None,
    workers: int,
    resume: bool,
    work: Callable[[Path, Execution], Path],
) -> None:
    """Run a study in its folder, with a bar, and show the text beside its table."""
    folder, stop = _folder(output, name), StopRequest()
    with stop.listening(), _bar(name) as progress:
        table = work(folder, Execution(workers, resume, progress, stop))
    text = table.with_suffix(".md").read_text(encoding="utf-8")
    out.print(text, highlight=False, markup=False, soft_wrap=True)
    out.print(f"results: {folder}", highlight=False, soft_wrap=True)
    if stop.asked:
        err.print(f"interrupted; --resume continues in {folder}", highlight=False)
        raise typer.Exit(INTERRUPTED)


@study.command("formation")
def formation_command(
    trials: Trials = 20,
    methods: Annotated[str, typer.Option(help="Controllers, comma separated.")] = "apnc,apc",
    mi: Annotated[
        list[float] | None, typer.Option(help="Modulatory input; repeatable. All 13 if omitted.")
    ] = None,
    duration: Duration = 45.0,
    workers: Workers = 2,
    output: Output = None,
    resume: Resume = False,
) -> None:
    """Convergence of the gait over MI on flat ground (Fig. 4)."""
    names = tuple(name.strip() for name in methods.split(","))

    def work(folder: Path, execution: Execution) -> Path:
        return run_formation(folder, trials, tuple(mi or MI_VALUES), names, duration, execution)

    _run("formation", output, workers, resume, work)


@study.command("states")
def states_command(
    trials: Trials = 20, workers: Workers = 2, output: Output = None, resume: Resume = False
) -> None:
    """States S1 to S3 in detail, with a picture of one run (Fig. 9-12)."""
    _run("states", output, workers, resume, lambda folder, how: run_memory(folder, trials, how))


@study.command("sensitivity")
def sensitivity_command(
    trials: Trials = 3,
    change: Annotated[
        list[str] | None, typer.Option(help="What is changed; repeatable. All if omitted.")
    ] = None,
    duration: Duration = 45.0,
    workers: Workers = 2,
    output: Output = None,
    resume: Resume = False,
) -> None:
    """What a change of one number of the robot does to the gait."""
    changes = change or tuple(CHANGES)

    def work(folder: Path, execution: Execution) -> Path:
        return run_sensitivity(folder, trials, changes, duration, execution)

    _run("sensitivity", output, workers, resume, work)


@study.command("contact")
def contact_command(output: Output = None) -> None:
    """Step-size study of the ground contact."""
    folder = _folder(output, "contact")
    with _bar("contact") as progress:
        contact_study.run(folder, lambda share: progress(round(100.0 * share), 100.0))
    out.print(f"results: {folder}", highlight=False, soft_wrap=True)
