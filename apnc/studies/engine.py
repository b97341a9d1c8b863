"""Runs a study: what is missing, on whatever workers, into one table."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Final

import apnc_core
from apnc.loop.csv_file import write_csv
from apnc.loop.engines import COMPILED
from apnc.loop.many import walk_many
from apnc.loop.record import Record
from apnc.loop.simulate import simulate
from apnc.report.folder import write_together
from apnc.studies.registry import ALL, METHODS, ROBOT, STUDIES, Entry, Registry, names_of
from apnc.studies.report import files_of
from apnc.studies.rows import PHASE, Row
from apnc.studies.store import Store, place_of
from apnc.studies.study import Chosen, Trial, load
from apnc.studies.workers import pool, rows_of
from apnc.summary import summarise
from build_fmu.build import host_fmu

Progress = Callable[[int, int, float, float], None]
"""Called with the trials done and their total, and the simulated time done and its total [s]."""

ROWS_FILE: Final = "trials.jsonl"

_LEFT_OUT: Final = ("method", "mi", "seed", "phi_target", "message",  # in the cell, or elsewhere
                    "real_time_factor", "fmu_share_of_wall_time")  # other at every run # fmt: skip


def run_study(
    name: str,
    *,
    trials: int = 20,
    methods: Sequence[str] | None = None,
    workers: int = 1,
    scheduler: str | None = None,
    output: Path | str | None = None,
    resume: bool = False,
    series: bool = False,
    duration: float | None = None,
    chosen: Chosen | None = None,
    robot: str | None = None,
    progress: Progress = lambda done, total, simulated, total_s: None,
    stop: Callable[[], bool] = lambda: False,
    studies: Registry = STUDIES,
) -> list[Row]:
    """Run a study, or ``all`` of the paper, and write its table, report and claims.

    Args:
        name: a study of the registry, or ``all``.
        trials: seeds per cell of the grid: 0 ... trials - 1.
        methods: labels of the contenders to compare; the study's own if omitted. With ``all``,
            studies that take no methods keep their own.
        workers: threads on this machine, of another engine than ``compiled`` processes.
        scheduler: address of a Dask scheduler; the trials then run there.
        output: folder, made if missing; None keeps no files.
        resume: keep what the folder holds of the very same experiments; those that ended with an
            error run again.
        series: keep the record of every trial, in ``series/``.
        duration: simulated time of every trial [s]; the study's own if omitted.
        chosen: values along axes of the grid, by name, which get all seeds of every method; the
            study's own if omitted.
        robot: name or file of the robot that walks; the study's own if omitted. With ``all``,
            studies that take none keep their own.
        progress: called after every trial.
        stop: asked a few times a second; True ends the study, what is finished stays.
        studies: where the name is looked up; the product's if omitted.

    Returns:
        The rows in the order of the grid, fewer if it was stopped.

    Raises:
        ValueError: a value outside what is allowed, or a folder that holds trials without
            ``resume``.
        OSError: a file cannot be written.
    """
    asked = grid_of(name, trials, methods, chosen, duration, robot, studies)
    grid = {trial.place: trial for trial in asked}
    folder = None if output is None else Path(output)
    path = None if folder is None else folder / ROWS_FILE
    if folder is None and series:
        raise ValueError("series are kept in a folder: give an output")
    if path is not None and path.exists() and path.stat().st_size > 0 and not resume:
        raise ValueError(f"{path} holds trials already; --resume continues them")
    total = sum(trial.experiment.duration for trial in grid.values())
    with pool(workers, scheduler, grid.values()) as executor, Store(path) as store:
        for legs in {len(trial.experiment.description.legs) for trial in grid.values()}:
            host_fmu(legs)  # built once here, not by every worker at the same time
        left = {at: t for at, t in grid.items() if store.rows.get(at, {}).get("error") != ""}
        missing = sum(trial.experiment.duration for trial in left.values())

        def tell() -> None:
            progress(len(grid) - len(left), len(grid), total - missing, total)

        tell()
        walk = partial(run_trials, series=folder / "series" if folder and series else None)
        for row in rows_of(
            list(left.values()), walk, executor,
            workers=workers, cluster=scheduler is not None, stop=stop,
        ):  # fmt: skip
            store.add(row)
            missing -= left.pop(place_of(row)).experiment.duration
            tell()
    rows = [store.rows[at] for at in grid if at in store.rows]
    if folder is not None:
        wall_s = sum(store.wall_s[at] for at in grid)
        write_together(folder, files_of(list(grid.values()), rows, wall_s, scenes=not left))
    return rows


def grid_of(
    name: str,
    trials: int,
    methods: Sequence[str] | None = None,
    chosen: Chosen | None = None,
    duration: float | None = None,
    robot: str | None = None,
    studies: Registry = STUDIES,
) -> list[Trial]:
    """The trials of a study, or of all of the paper's; see ``run_study``."""
    grid: list[Trial] = []
    for each in names_of(name, studies):
        options = (METHODS, ROBOT) if name != ALL else studies[each].options
        own_methods, own_robot = METHODS not in options, ROBOT not in options
        grid += load(studies[each]).grid(
            trials,
            None if own_methods else methods,
            chosen,
            duration,
            None if own_robot else robot,
        )
    return grid


def run_trials(
    trials: Sequence[Trial],
    *,
    workers: int = 1,
    stop: Callable[[], bool] = lambda: False,
    series: Path | None = None,
) -> Iterator[Row]:
    """Rows of trials as they finish; one that raises becomes a row with its error.

    Robots in C walk first, side by side, then those of other engines one after the other.

    Args:
        trials: what is run.
        workers: threads for the robots in C.
        stop: asked a few times a second, and before every robot of another engine.
        series: folder for the records, or None to keep none.
    """
    side_by_side = [trial for trial in trials if trial.experiment.engine == COMPILED]
    for index, found in walk_many(
        [trial.experiment for trial in side_by_side],
        lambda at, record: _row(side_by_side[at], record, series),
        workers=workers,
        stop=stop,
    ):
        yield _failed(side_by_side[index], found) if isinstance(found, Exception) else found
    for trial in trials:
        if trial.experiment.engine != COMPILED:
            if stop():
                return
            yield run_trial(trial, series)


def run_trial(trial: Trial, series: Path | None = None) -> Row:
    """Row of a single trial, see :func:`run_trials`."""
    try:
        return _row(trial, simulate(trial.experiment), series)
    except Exception as error:
        return _failed(trial, error)


def _row(trial: Trial, record: Record, series: Path | None) -> Row:
    if series is not None:
        series.mkdir(exist_ok=True)
        path = series / f"{'-'.join(trial.place)}.csv"
        write_csv(record, aside := path.with_suffix(".part"))
        aside.replace(path)
    return _begin(trial) | measured(trial.entry, record)


def _failed(trial: Trial, error: Exception) -> Row:
    text = " ".join(f"{type(error).__name__}: {error}".split())
    return _begin(trial) | {"version": apnc_core.__version__, "end": "error", "error": text}


def _begin(trial: Trial) -> Row:
    return {"study": trial.study, "key": trial.place[-1], **trial.cell}


def measured(study: Entry, record: Record) -> Row:
    """Summary and the study's own figures of a record, how it ended, and what broke down."""
    found = summarise(record).to_dict()
    ended = {"ended_at_s": found.pop("duration_s"), "end": found.pop("end")}
    phases = {f"{PHASE}{k}": phi for k, phi in enumerate(found.pop("phi_final"), start=2)}
    single = {k: v for k, v in found.items() if k not in _LEFT_OUT and not isinstance(v, dict)}
    own = {name: _finite(value) for name, value in load(study).measure(record).items()}
    return single | phases | own | ended | {"error": record.message}


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value
