"""Run a study: what is missing, on whatever workers, into one folder."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from apnc.studies.evaluation.store import Store, write_table
from apnc.studies.evaluation.trial import Row, Trial
from apnc.studies.evaluation.workers import Workers
from build_fmu.build import host_fmu

Progress = Callable[[int, float], None]

ROWS_FILE = "trials.jsonl"
TABLE_FILE = "trials.csv"


def run_study(
    trials: Sequence[Trial],
    pool: Workers,
    folder: Path,
    *,
    resume: bool = False,
    series: bool = False,
    progress: Progress = lambda done, simulated: None,
    stop: Callable[[], bool] = lambda: False,
) -> list[Row]:
    """Run the trials that the folder does not hold yet and return the rows of all.

    Args:
        trials: the configurations.
        pool: where they run.
        folder: existing folder for ``trials.jsonl``, ``trials.csv`` and ``series/``.
        resume: keep the finished trials of an earlier, interrupted study in the folder.
        series: keep the time series of every trial.
        progress: called with the number of finished trials and their simulated time [s].
        stop: asked after every trial; True ends the study, what is finished stays.

    Raises:
        ValueError: the folder holds trials and ``resume`` is not set.
        OSError: a file cannot be written.
    """
    path = folder / ROWS_FILE
    if path.is_file() and not resume:
        raise ValueError(f"{path} holds trials already; --resume continues them")
    series_folder = folder / "series" if series else None
    if series_folder:
        series_folder.mkdir(exist_ok=True)
    host_fmu()  # built once here, not by every worker at the same time
    store = Store(path)
    try:
        missing = [trial for trial in trials if trial.key not in store.rows]
        done = len(trials) - len(missing)
        simulated = sum(t.duration for t in trials if t.key in store.rows)
        progress(done, simulated)
        for row in pool.rows(missing, series_folder) if missing else ():
            store.add(row)
            done, simulated = done + 1, simulated + row["duration"]
            progress(done, simulated)
            if stop():
                break
    finally:
        store.close()
    wanted = {trial.key for trial in trials}
    rows = [row for key, row in store.rows.items() if key in wanted]
    write_table(rows, folder / TABLE_FILE)
    return rows
