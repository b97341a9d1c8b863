"""``apnc study mi``, ``rate``, ... ``all``: the experiments of the paper, one command each."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated, Final

import joblib
import typer

from apnc.cli.console import INTERRUPTED, StopRequest, err, out, study_bar, writable
from apnc.studies.evaluation.grids import METHODS, STUDIES, trials_of
from apnc.studies.evaluation.report import write_evaluation
from apnc.studies.evaluation.run import run_study
from apnc.studies.evaluation.workers import workers as workers_of

Trials = Annotated[int, typer.Option(help="Seeds per cell of the grid.")]
Methods = Annotated[str, typer.Option(help="Controllers to compare, separated by commas.")]
Count = Annotated[int | None, typer.Option("--workers", help="Processes; all cores by default.")]
Scheduler = Annotated[str | None, typer.Option(help="Address of a Dask scheduler, tcp://...")]
ALL_METHODS: Final = ",".join(METHODS)
Output = Annotated[Path | None, typer.Option(help="Folder; apnc-study-NAME by default.")]
Resume = Annotated[bool, typer.Option("--resume", help="Finish an interrupted study.")]
Series = Annotated[bool, typer.Option("--series", help="Keep the time series of every trial.")]


def evaluate(
    name: str,
    trials: int,
    methods: str,
    workers: int | None,
    scheduler: str | None,
    output: Path | None,
    resume: bool,
    series: bool,
) -> None:
    """Run one study, or all, and write its table, report and claims.

    Raises:
        ValueError: an unknown study or method, or an option out of range.
    """
    chosen = trials_of(name, trials, [m.strip() for m in methods.split(",") if m.strip()])
    folder = writable(output or Path(f"apnc-study-{name}"))
    pool = workers_of(workers if workers is not None else _cores(), scheduler)
    stop, begin = StopRequest(), time.perf_counter()
    simulated = sum(trial.duration for trial in chosen)
    with stop.listening(), study_bar(name, len(chosen), simulated) as progress:
        rows = run_study(
            chosen, pool, folder, resume=resume, series=series, progress=progress, stop=stop
        )
    write_evaluation(rows, folder, time.perf_counter() - begin)
    failed = sum(bool(row["error"]) for row in rows)
    out.print(f"{len(rows)} of {len(chosen)} trials, {failed} ended with an error")
    out.print(f"report: {folder}/report.html", highlight=False, soft_wrap=True)
    if stop.asked:
        err.print("interrupted; --resume finishes it", highlight=False)
        raise typer.Exit(INTERRUPTED)


def _cores() -> int:
    return int(joblib.cpu_count())


def _add(study: typer.Typer, name: str, about: str) -> None:
    @study.command(name, help=about)
    def command(
        trials: Trials = 20,
        methods: Methods = ALL_METHODS,
        workers: Count = None,
        scheduler: Scheduler = None,
        output: Output = None,
        resume: Resume = False,
        series: Series = False,
    ) -> None:
        evaluate(name, trials, methods, workers, scheduler, output, resume, series)


def add_evaluation(study: typer.Typer) -> None:
    """Add one command per experiment of the paper, and ``all``."""
    for each in STUDIES.values():
        _add(study, each.name, f"{each.title} ({each.place} of the paper).")
    _add(study, "all", "All of the paper's experiments, one report.")
