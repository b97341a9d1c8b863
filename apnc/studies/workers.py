"""Where trials run: in this process, in several of this machine, or on a Dask cluster."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from itertools import islice, takewhile
from typing import Any

from apnc.studies.rows import Row
from apnc.studies.study import Trial


@contextmanager
def pool(workers: int, scheduler: str | None) -> Iterator[Executor | None]:
    """The workers asked for, see ``run_study``; None is this process.

    Raises:
        ValueError: fewer than one process, the extra ``cluster`` is missing, or no scheduler there.
    """
    if scheduler:
        with _client(scheduler) as client:
            yield client.get_executor(retries=3, pure=False)  # a lost worker's trials run elsewhere
    elif workers < 1:
        raise ValueError(f"workers = {workers} is not at least 1")
    elif workers == 1:
        yield None
    else:
        try:
            from loky import get_reusable_executor  # noqa: PLC0415  # an extra
        except ImportError:
            extra = "pip install 'apnc[study]', or --workers 1"
            raise ValueError(f"workers = {workers} needs the extra 'study': {extra}") from None
        executor = get_reusable_executor(workers, initializer=_leave_interrupts_to_parent)
        with _interrupts_ignored():
            executor.submit(int)  # starts the processes, which ignore Ctrl-C from then on
        yield executor


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


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Ctrl-C has no effect in here, nor, until they say otherwise, in processes started here."""
    if threading.current_thread() is not threading.main_thread():  # others may not set signals
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _leave_interrupts_to_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def rows_of(
    trials: Sequence[Trial],
    work: Callable[[Trial], Row],
    executor: Executor | None,
    at_once: int,
    stop: Callable[[], bool],
) -> Iterator[Row]:
    """Rows as they finish, in any order; once ``stop()`` is true, no further trial begins."""
    left = takewhile(lambda _: not stop(), trials)
    if executor is None:
        yield from map(work, left)
        return
    running: set[Future[Row]] = set()
    while True:
        running |= {executor.submit(work, trial) for trial in islice(left, at_once - len(running))}
        if not running:
            return
        done, running = wait(running, return_when=FIRST_COMPLETED)
        yield from (future.result() for future in done if not future.cancelled())
        if stop():
            for future in running:  # of those that wait on a cluster
                future.cancel()
