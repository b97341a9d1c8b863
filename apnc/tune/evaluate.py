"""Runs of candidates, walked in C in processes of this machine or on a Dask cluster."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, wait
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Final

from apnc.loop.batch import Stop
from apnc.loop.many import walk_many
from apnc.loop.record import Record
from apnc.tune.costs import total, weights_of
from apnc.tune.design import Start, candidate
from apnc.tune.measured import SIGNALS, Measured
from apnc.tune.paper import measured_of_paper, of_paper
from apnc.tune.runs import MI_COUNT, Extra, Task, of_generation
from apnc_core.types import Array

CHUNK: Final = 64
"""Runs in one task of a cluster; they take about a second."""

CANDIDATES: Final = 4
"""Candidates in one task of a cluster: about as many runs."""

_POLL_S: Final = 0.2
"""How often ``stop`` is asked while others work [s]."""


class Stopped(Exception):  # noqa: N818  # no error
    """The runs were stopped before all of them had ended."""


@dataclass(frozen=True)
class Evaluator:
    """Walks runs and measures them. The result depends on the runs only, not on who walks them.

    Python prepares and measures a run in about as long as C walks it, so threads would wait for
    each other: the work is shared out to processes.

    Args:
        start: what is tuned.
        executor: processes or a cluster; None: this thread does all.
        workers: number of processes; None: a cluster.
        stop: asked a few times a second; True ends the work.
    """

    start: Start
    executor: Executor | None = None
    workers: int | None = 1
    stop: Stop = lambda: False

    def __call__(self, tasks: Sequence[Task]) -> list[Measured]:
        """What is measured of each run, in their order.

        Raises:
            Stopped: ``stop`` ended the work.
            ValueError: an experiment that cannot be run.
        """
        if self.executor is None:
            return _walked(self.start, tasks, self.stop)
        parts = self._parts(tasks, CHUNK)
        return [each for part in self._sent(_walked, parts) for each in part]

    def costs(self, points: Sequence[Array], seed: int) -> tuple[list[float], float]:
        """Costs of the candidates of a generation, and the time that they walked [s].

        Args:
            points: the candidates, a coordinate in [0, 1] for each variable.
            seed: of the generation.

        Raises:
            Stopped: ``stop`` ended the work.
        """
        if self.executor is None:
            return _costs(self.start, points, seed, self.stop)
        parts = self._sent(_costs, self._parts(points, CANDIDATES), seed)
        return [cost for costs, _ in parts for cost in costs], math.fsum(time for _, time in parts)

    def _parts(self, whole: Sequence[Any], size: int) -> list[Sequence[Any]]:
        """Parts of one size for a cluster, else one for each process."""
        if self.workers is not None:
            size = max(1, math.ceil(len(whole) / self.workers))
        return [whole[at : at + size] for at in range(0, len(whole), size)]

    def _sent(self, do: Callable[..., Any], parts: Sequence[Sequence[Any]], *more: Any) -> Any:
        assert self.executor is not None
        sent = [self.executor.submit(do, self.start, part, *more) for part in parts]
        while left := [future for future in sent if not future.done()]:
            if self.stop():
                for future in left:
                    future.cancel()
                raise Stopped
            wait(left, timeout=_POLL_S, return_when="FIRST_COMPLETED")
        return [future.result() for future in sent]


def _never() -> bool:
    return False


def _costs(
    start: Start, points: Sequence[Array], seed: int, stop: Stop = _never
) -> tuple[list[float], float]:
    tried = [candidate(start, x) for x in points]
    # the paper's range is wide
    count = 7 if start.paper else MI_COUNT
    plan = of_generation(start, tried, seed, count=count, extra=extra_of(start))
    tasks = [task for tasks in plan for task in tasks]
    found = _walked(start, tasks, stop)
    each = len(plan[0])
    costs = [
        total(plan[k], found[k * each : (k + 1) * each], weights_of(start))
        for k in range(len(plan))
    ]
    return costs, seconds(tasks)


def extra_of(start: Start) -> Extra | None:
    """What makes more runs of each candidate."""
    return of_paper if start.paper else None


def _walked(start: Start, tasks: Sequence[Task], stop: Stop = _never) -> list[Measured]:
    def measure(index: int, record: Record) -> Measured:
        return measured_of_paper(start, tasks[index], record)

    found: list[Measured | None] = [None] * len(tasks)
    experiments = [task.experiment for task in tasks]
    for index, result in walk_many(experiments, measure, stop=stop, signals=SIGNALS):
        if isinstance(result, Exception):
            raise result
        found[index] = result
    if None in found:
        raise Stopped
    return found  # type: ignore[return-value]  # none is missing


def seconds(tasks: Sequence[Task]) -> float:
    """Simulated time of runs [s]."""
    return math.fsum(task.experiment.duration for task in tasks)


@contextmanager
def evaluator_of(
    start: Start, workers: int, scheduler: str | None, stop: Stop
) -> Iterator[Evaluator]:
    """What walks the runs: this thread, processes of this machine, or a cluster.

    Args:
        start: what is tuned.
        workers: number of processes of this machine; 1: this thread.
        scheduler: address of a Dask scheduler whose workers walk instead.
        stop: asked a few times a second; True ends the work.

    Raises:
        ValueError: a missing extra, or no scheduler at the address.
    """
    if scheduler is None and workers == 1:
        yield Evaluator(start, stop=stop)
        return
    from apnc.studies.workers import client, processes  # noqa: PLC0415  # takes long to import

    if scheduler is None:
        yield Evaluator(start, processes(workers, "tune"), workers, stop)
        return
    with client(scheduler) as found:
        yield Evaluator(start, found.get_executor(pure=False), None, stop)
