"""Runs trials in threads of this process, in processes of this machine, or on a Dask cluster."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from functools import partial
from itertools import islice, takewhile
from typing import Any, Final, Protocol

from apnc.extras import install_command
from apnc.loop.batch import Lanes, Stop, lanes_of
from apnc.studies.results import Result
from apnc.studies.study import Trial

CHUNK: Final = 32
"""Number of trials in C in one task of a cluster. They take about a second."""

_TO_STOP: Final = (signal.SIGINT, signal.SIGTERM)
"""Signals that end a study. They also reach the worker processes, which ignore them."""


_BLAS_THREADS: Final = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
"""Variables that limit the threads of linear algebra. As many processes as there are cores would
take the cores from each other with threads that wait in a loop."""


class Walk(Protocol):
    """Runs trials in this process and gives results as they finish, in any order."""

    def __call__(self, trials: Sequence[Trial], *, workers: int, stop: Stop) -> Iterator[Result]:
        """Results of the trials, those in C on ``workers`` threads."""


@contextmanager
def pool(
    workers: int, scheduler: str | None, trials: Collection[Trial]
) -> Iterator[Executor | None]:
    """Executor for the trials that run outside this process. None if all trials run inside.

    Arguments are those of ``run_study``.

    Raises:
        ValueError: fewer than one worker, a missing extra, or no scheduler at the address.
    """
    if scheduler:
        with client(scheduler) as connected:
            # trials of a lost worker run elsewhere
            yield connected.get_executor(retries=3, pure=False)
        return
    if workers < 1:
        raise ValueError(f"workers = {workers} is not at least 1")
    others = {t.experiment.engine for t in trials if not t.in_c}
    if not others or workers == 1:
        yield None
        return
    yield processes(workers, "study", f" with engine {min(others)}")


def processes(workers: int, extra: str, what: str = "") -> Any:
    """Executor of processes on this machine, which leave signals to their parent.

    Args:
        workers: number of processes.
        extra: extra that brings the package that it needs.
        what: what needs them, for the message if it is missing.

    Raises:
        ValueError: a missing extra.
    """
    try:
        from loky import get_reusable_executor  # noqa: PLC0415  # an extra
    except ImportError:
        needs = f"workers = {workers}{what} needs the extra '{extra}'"
        raise ValueError(f"{needs}: {install_command(extra)}, or --workers 1") from None
    executor = get_reusable_executor(
        workers, initializer=_leave_interrupts_to_parent, env=dict.fromkeys(_BLAS_THREADS, "1")
    )
    with _interrupts_ignored():
        executor.submit(int)  # starts the processes, which ignore the signals from then on
    return executor


def client(address: str) -> Any:
    """Client of the Dask scheduler at an address.

    Raises:
        ValueError: a missing extra, or no scheduler at the address.
    """
    try:
        from dask.distributed import Client  # noqa: PLC0415  # an extra
    except ImportError:
        needs = "a scheduler needs the extra 'cluster'"
        raise ValueError(f"{needs}: {install_command('cluster')}") from None
    try:
        return Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise ValueError(f"no Dask scheduler at {address}: {error}") from None


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Ignore the signals that stop, here and in processes that are started meanwhile."""
    if threading.current_thread() is not threading.main_thread():  # others may not set signals
        yield
        return
    before = {number: signal.signal(number, signal.SIG_IGN) for number in _TO_STOP}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _leave_interrupts_to_parent() -> None:
    for number in _TO_STOP:
        signal.signal(number, signal.SIG_IGN)


def results_of(
    trials: Sequence[Trial],
    walk: Walk,
    executor: Executor | None,
    *,
    workers: int,
    cluster: bool,
    stop: Stop,
) -> Iterator[Result]:
    """Results as they finish, in any order. No trial begins after ``stop`` has returned True.

    Args:
        trials: the trials to run.
        walk: function that runs trials. It is sent to other processes.
        executor: executor of :func:`pool`, or None.
        workers: number of threads for trials in C, and of processes for the others.
        cluster: send all trials to the executor, those in C in chunks.
        stop: called now and then.
    """
    here, sent = trials, list[Trial]()
    if executor is not None:
        here = [] if cluster else [t for t in trials if t.in_c]
        sent = [t for t in trials if cluster or not t.in_c]
    yield from walk(here, workers=workers, stop=stop)
    if executor is not None and (chunks := chunks_of(sent)):
        at_once = len(chunks) if cluster else workers
        yield from _sent(chunks, partial(_all_of, walk), executor, at_once, stop)


def chunks_of(trials: Sequence[Trial]) -> list[list[Trial]]:
    """Groups of trials that can walk side by side. A trial in another engine is its own group."""
    kinds: dict[Lanes, list[Trial]] = {}
    for trial in trials:
        if trial.in_c:
            kinds.setdefault(lanes_of(trial.experiment), []).append(trial)
    others = [[trial] for trial in trials if not trial.in_c]
    parts = (kind[at : at + CHUNK] for kind in kinds.values() for at in range(0, len(kind), CHUNK))
    return [*parts, *others]


def _all_of(walk: Walk, trials: Sequence[Trial]) -> list[Result]:
    return list(walk(trials, workers=1, stop=_never))


def _never() -> bool:
    return False


def _sent(
    chunks: Sequence[Sequence[Trial]],
    work: Callable[[Sequence[Trial]], list[Result]],
    executor: Executor,
    at_once: int,
    stop: Stop,
) -> Iterator[Result]:
    left = takewhile(lambda _: not stop(), chunks)
    running: set[Future[list[Result]]] = set()
    while True:
        running |= {executor.submit(work, chunk) for chunk in islice(left, at_once - len(running))}
        if not running:
            return
        done, running = wait(running, return_when=FIRST_COMPLETED)
        for future in done:
            if not future.cancelled():
                yield from future.result()
        if stop():
            for future in running:  # those that wait on a cluster
                future.cancel()
