"""Runs the trials of a study that have no result yet, and writes its results and report."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Final

import apnc_core
from apnc.features import walk_features
from apnc.loop.batch import Stop
from apnc.loop.csv_file import write_csv
from apnc.loop.many import walk_many
from apnc.loop.of_robot import warn_of_mi
from apnc.loop.record import Record
from apnc.loop.simulate import walk_one
from apnc.studies.registry import ALL, CONTROLLERS_OPTION, ROBOT, STUDIES, Entry, Registry, names_of
from apnc.studies.report import files_of
from apnc.studies.results import PHASE, Result, StudyResults, id_of
from apnc.studies.store import Store
from apnc.studies.study import Axes, Trial, load
from apnc.studies.workers import pool, results_of
from build_fmu.build import host_fmu
from build_fmu.writing import write_atomically, write_together

StudyProgress = Callable[[int, int, float, float], None]
"""Called with trials done, all trials, simulated time done [s] and simulated time of all [s]."""

RESULTS_FILE: Final = "trials.jsonl"

_LEFT_OUT: Final = (
    *("controller", "mi", "seed", "phi_target", "message"),  # in the cell, or elsewhere
    *("real_time_factor", "fmu_share_of_wall_time"),  # other at every run
)


def run_study(
    name: str,
    *,
    trials: int = 20,
    controllers: Sequence[str] | None = None,
    workers: int = 1,
    scheduler: str | None = None,
    output: Path | str | None = None,
    resume: bool = False,
    series: bool = False,
    duration: float | None = None,
    chosen: Axes | None = None,
    robot: str | None = None,
    progress: StudyProgress = lambda done, total, simulated, total_s: None,
    stop: Stop = lambda: False,
    studies: Registry = STUDIES,
) -> StudyResults:
    """Run a study, or all studies of the paper, and write results, report and claims.

    Args:
        name: name of a study in ``studies``, or ``all`` for all that reproduce the paper.
        trials: number of seeds per cell of the grid. Seeds are 0 ... trials - 1.
        controllers: labels of the controllers to compare. Default: those of the study. With
            ``all``, studies without this option keep their own.
        workers: number of threads on this machine. Engines other than ``compiled`` use processes.
        scheduler: address of a Dask scheduler that runs the trials.
        output: folder for the files. It is made if missing. None writes no files.
        resume: keep the results in the folder whose experiments are still the same. Trials that
            ended with an error run again.
        series: write the record of every trial to the folder ``series`` in ``output``.
        duration: simulated time of every trial [s]. Default: that of the study.
        chosen: values along axes of the grid, by name of the axis. Every controller then runs all
            seeds at all of them. Default: values and seeds of the study.
        robot: robot name or TOML file. Default: the robot of the study. With ``all``, studies
            without this option keep their own.
        progress: called after every trial.
        stop: called a few times a second. When it returns True the study ends with the results
            it has.
        studies: registry that holds the name. Default: the studies of the product.

    Returns:
        The results in the order of the grid. A study that was stopped has fewer.

    Raises:
        ValueError: a value that is not allowed, or results in the folder without ``resume``.
        OSError: a file cannot be written.
    """
    asked = grid_of(name, trials, controllers, chosen, duration, robot, studies)
    grid = {trial.id: trial for trial in asked}
    folder = None if output is None else Path(output)
    path = None if folder is None else folder / RESULTS_FILE
    if folder is None and series:
        raise ValueError("series are kept in a folder: give an output")
    if path is not None and path.exists() and path.stat().st_size > 0 and not resume:
        raise ValueError(f"{path} holds trials already; --resume continues them")
    warn_of_mi(trial.experiment for trial in asked)
    total = sum(trial.experiment.duration for trial in grid.values())
    with pool(workers, scheduler, grid.values()) as executor, Store(path) as store:
        for legs in {len(trial.experiment.description.legs) for trial in grid.values()}:
            host_fmu(legs)  # built once here, not by every worker at the same time
        left = {at: t for at, t in grid.items() if store.results.get(at, {}).get("error") != ""}
        missing = sum(trial.experiment.duration for trial in left.values())

        def tell() -> None:
            progress(len(grid) - len(left), len(grid), total - missing, total)

        tell()
        walk = partial(run_trials, series=folder / "series" if folder and series else None)
        for result in results_of(
            list(left.values()), walk, executor,
            workers=workers, cluster=scheduler is not None, stop=stop,
        ):  # fmt: skip
            store.add(result)
            missing -= left.pop(id_of(result)).experiment.duration
            tell()
    results = StudyResults(store.results[at] for at in grid if at in store.results)
    if folder is not None:
        wall_s = sum(store.wall_s[at] for at in grid)
        write_together(folder, files_of(list(grid.values()), results, wall_s, scenes=not left))
    return results


def grid_of(
    name: str,
    trials: int,
    controllers: Sequence[str] | None = None,
    chosen: Axes | None = None,
    duration: float | None = None,
    robot: str | None = None,
    studies: Registry = STUDIES,
) -> list[Trial]:
    """The trials of a study, or of all studies of the paper. Arguments as in ``run_study``."""
    grid: list[Trial] = []
    for each in names_of(name, studies):
        options = (CONTROLLERS_OPTION, ROBOT) if name != ALL else studies[each].options
        own_controllers, own_robot = CONTROLLERS_OPTION not in options, ROBOT not in options
        grid += load(studies[each]).grid(
            trials,
            None if own_controllers else controllers,
            chosen,
            duration,
            None if own_robot else robot,
        )
    return grid


def run_trials(
    trials: Sequence[Trial],
    *,
    workers: int = 1,
    stop: Stop = lambda: False,
    series: Path | None = None,
) -> Iterator[Result]:
    """Run trials and give their results as they finish.

    Trials in C run first, side by side. Trials in other engines, and those whose study makes the
    robot itself, follow one by one; a study with several workers calls this in several processes. A
    trial that raises gives a result with its error.

    Args:
        trials: the trials to run.
        workers: number of threads for the trials in C.
        stop: called a few times a second, and before every trial in another engine. No trial
            begins after it has returned True.
        series: folder for the records. None keeps no records.
    """
    side_by_side = [trial for trial in trials if trial.in_c]
    for index, found in walk_many(
        [trial.experiment for trial in side_by_side],
        lambda at, record: _result(side_by_side[at], record, series),
        workers=workers,
        stop=stop,
    ):
        yield _failed(side_by_side[index], found) if isinstance(found, Exception) else found
    for trial in trials:
        if not trial.in_c:
            if stop():
                return
            yield run_trial(trial, series)


def run_trial(trial: Trial, series: Path | None = None) -> Result:
    """Run one trial and give its result, see :func:`run_trials`."""
    made = load(trial.entry).plant
    try:
        plant = None if made is None else made(trial.experiment)
        return _result(trial, walk_one(trial.experiment, plant=plant), series)
    except Exception as error:
        return _failed(trial, error)


def _result(trial: Trial, record: Record, series: Path | None) -> Result:
    if series is not None:
        path = series / f"{'-'.join(trial.id)}.csv"
        write_atomically(path, partial(write_csv, record))
    return _begin(trial) | measured(trial.entry, record)


def _failed(trial: Trial, error: Exception) -> Result:
    text = " ".join(f"{type(error).__name__}: {error}".split())
    return _begin(trial) | {"version": apnc_core.__version__, "end": "error", "error": text}


def _begin(trial: Trial) -> Result:
    return {"study": trial.study, "key": trial.id.key, **trial.cell}


def measured(study: Entry, record: Record) -> Result:
    """The result of a record: its summary, the measures of the study, its end and its error."""
    found = walk_features(record).to_dict()
    ended = {"ended_at_s": found.pop("duration_s"), "end": found.pop("end")}
    phases = {f"{PHASE}{k}": phi for k, phi in enumerate(found.pop("phi_final"), start=2)}
    single = {k: v for k, v in found.items() if k not in _LEFT_OUT and not isinstance(v, dict)}
    own = {name: _finite(value) for name, value in load(study).measure(record).items()}
    return single | phases | own | ended | {"error": record.message}


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value
