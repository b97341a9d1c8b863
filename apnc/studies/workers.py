"""Where trials run: on this machine's cores, or on a Dask cluster."""

from __future__ import annotations

import multiprocessing
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from itertools import takewhile
from typing import Any

from apnc.studies.rows import Row
from apnc.studies.study import Trial

Work = Callable[[Trial], Row]
Stop = Callable[[], bool]
Pool = Callable[[Sequence[Trial], Work, Stop], Iterator[Row]]
"""Rows of trials as they finish, in any order; once ``stop()`` is true, no further trial begins."""


def pool(workers: int, scheduler: str | None) -> Pool:
    """The workers asked for.

    Args:
        workers: processes on this machine, if no scheduler is given; 1 runs in this one.
        scheduler: address of a Dask scheduler, such as ``tcp://127.0.0.1:8786``, or None.

    Raises:
        ValueError: fewer than one process, the extra ``cluster`` is missing, or no scheduler there.
    """
    if scheduler:
        return _cluster(_client(scheduler))
    if workers < 1:
        raise ValueError(f"workers = {workers} is not at least 1")
    return _processes(workers) if workers > 1 else _here


def _here(trials: Sequence[Trial], work: Work, stop: Stop) -> Iterator[Row]:
    return (work(trial) for trial in takewhile(lambda _: not stop(), trials))


def _processes(count: int) -> Pool:
    def rows(trials: Sequence[Trial], work: Work, stop: Stop) -> Iterator[Row]:
        import joblib  # noqa: PLC0415  # not needed by a single process

        # no more than what runs is handed out, so that a stop comes soon
        handed = {"pre_dispatch": "n_jobs", "batch_size": 1}
        parallel = joblib.Parallel(n_jobs=count, return_as="generator_unordered", **handed)
        left = takewhile(lambda _: not stop(), trials)
        yield from parallel(joblib.delayed(_deaf)(work, trial) for trial in left)

    return rows


def _deaf(work: Work, trial: Trial) -> Row:
    """Leave Ctrl-C to the process that hands out the trials."""
    child = multiprocessing.current_process().name != "MainProcess"
    if child and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    return work(trial)


def _client(address: str) -> Any:
    try:
        from dask.distributed import Client  # noqa: PLC0415  # an extra
    except ImportError:
        extra = "pip install 'apnc[cluster]'"
        raise ValueError(f"a scheduler needs the extra 'cluster': {extra}") from None
    try:
        return Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise ValueError(f"no Dask scheduler at {address}: {error}") from None


def _cluster(client: Any) -> Pool:
    def rows(trials: Sequence[Trial], work: Work, stop: Stop) -> Iterator[Row]:
        from dask.distributed import as_completed  # noqa: PLC0415  # an extra

        names = ["-".join(trial.place) for trial in trials]
        # a lost worker's trials run elsewhere
        futures = client.map(work, trials, key=names, retries=3) if trials else []
        try:
            for future in as_completed(futures):
                yield future.result()
                future.release()
                if stop():
                    return
        finally:
            client.cancel(futures)
            client.close()

    return rows
