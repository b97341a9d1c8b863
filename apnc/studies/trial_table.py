"""Many independent trials into one CSV table: in parallel, one row each, resumable."""

from __future__ import annotations

import csv
import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, fields
from multiprocessing import get_context
from pathlib import Path
from typing import Any

Row = dict[str, Any]
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Execution:
    """How a list of trials is run.

    Args:
        workers: processes; 1 runs in this one.
        resume: keep the rows of an earlier run; those with an error are run again.
        progress: called with the numbers of finished and of all trials.
        stop: asked between trials; True ends the run, what is finished stays.

    Raises:
        ValueError: bad number of workers.
    """

    workers: int = 1
    resume: bool = False
    progress: Progress = lambda done, total: None
    stop: Callable[[], bool] = lambda: False

    def __post_init__(self) -> None:
        """Check the number of workers."""
        if self.workers < 1:
            raise ValueError(f"workers = {self.workers} is not 1 or more")


def run_trials(
    trials: Sequence[Any],
    work: Callable[[Any], Row],
    path: Path,
    execution: Execution | None = None,
) -> list[Row]:
    """Run every trial that the table does not hold yet.

    Args:
        trials: what to run: dataclasses whose fields, the first columns of a row, tell them apart.
        work: importable function from a trial to its row; all rows have the same columns. What it
            raises becomes the entry ``error`` of a row that holds nothing else.
        path: the table, in a folder that is made if missing; rows are appended as they come and
            sorted like ``trials`` at the end.
        execution: how; in this process, from the start, if omitted.

    Returns:
        The rows as text, in the order of ``trials``; fewer if it was stopped.

    Raises:
        ValueError: no trial, or a table that is there without ``resume``.
        OSError: the table cannot be written.
    """
    how = execution or Execution()
    if not trials:
        raise ValueError("there is no trial to run")
    if path.exists() and not how.resume:
        raise ValueError(f"{path} is there already; resume it or choose another folder")
    path.parent.mkdir(parents=True, exist_ok=True)
    names = [field.name for field in fields(trials[0])]

    def key(row: Mapping[str, Any]) -> tuple[str, ...]:
        return tuple(str(row.get(name)) for name in names)

    order = [key(vars(trial)) for trial in trials]
    kept = {key(row): row for row in (_finished(path) if how.resume else [])}
    rows = {k: kept[k] for k in order if k in kept}
    missing = [t for t, k in zip(trials, order, strict=True) if k not in rows]
    _rewrite(path, list(rows.values()))
    how.progress(len(rows), len(trials))
    for trial, row in _results(missing, work, how.workers, how.stop):
        text = {name: "" if value is None else str(value) for name, value in row.items()}
        rows[key(vars(trial))] = text
        _append(path, text)
        how.progress(len(rows), len(trials))
    ordered = [rows[k] for k in order if k in rows]
    _rewrite(path, ordered)
    return ordered


def _results(
    trials: Sequence[Any], work: Callable[[Any], Row], workers: int, stop: Callable[[], bool]
) -> Iterator[tuple[Any, Row]]:
    if workers == 1:
        for trial in trials:
            if stop():
                return
            yield trial, _guarded(work, trial)
        return
    waiting = list(reversed(trials))
    running: dict[Future[Row], Any] = {}
    with _pool(workers) as pool:
        while waiting or running:
            while waiting and len(running) < 2 * workers and not stop():
                trial = waiting.pop()
                running[pool.submit(_guarded, work, trial)] = trial
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()


@contextmanager
def _pool(workers: int) -> Iterator[ProcessPoolExecutor]:
    # fresh processes: a fork of a process with threads (a progress bar) may lock up
    with ProcessPoolExecutor(workers, get_context("spawn"), initializer=_deaf) as pool:
        yield pool


def _deaf() -> None:
    """Leave Ctrl-C to the process that hands out the trials."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _guarded(work: Callable[[Any], Row], trial: Any) -> Row:
    try:
        return {**work(trial), "error": None}
    except Exception as error:  # a trial that raises is a row, not the end of the study
        return {**vars(trial), "error": f"{type(error).__name__}: {error}"}


def _finished(path: Path) -> list[Row]:
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    # a row cut off by a crash has no last entry
    return [row for row in rows if row.get("error") == ""]


def _append(path: Path, row: Row) -> None:
    if not path.exists() or path.stat().st_size == 0 or len(row) > len(_header(path)):
        _rewrite(path, [*_all_rows(path), row])
        return
    with path.open("a", newline="", encoding="utf-8") as file:
        csv.DictWriter(file, _header(path)).writerow(row)


def _all_rows(path: Path) -> list[Row]:
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _header(path: Path) -> list[str]:
    with path.open(newline="", encoding="utf-8") as file:
        return next(csv.reader(file), [])


def _rewrite(path: Path, rows: Sequence[Row]) -> None:
    """Write the whole table at once: never half of it, whatever happens."""
    names = max((list(row) for row in rows), key=len, default=[])
    beside = path.with_name(path.name + ".new")
    with beside.open("w", newline="", encoding="utf-8") as file:
        if names:
            writer = csv.DictWriter(file, names)
            writer.writeheader()
            writer.writerows(rows)
    beside.replace(path)
