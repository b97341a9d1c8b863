"""Runs of candidates, walked in C on the threads of this process or on a Dask cluster."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any, Final

from apnc.loop.batch import Stop
from apnc.loop.many import walk_many
from apnc.loop.record import Record
from apnc.tune.design import Start
from apnc.tune.measured import Measured
from apnc.tune.paper import measured_of_paper
from apnc.tune.runs import Task

CHUNK: Final = 64
"""Runs in one task of a cluster; they take about a second."""


class Stopped(Exception):  # noqa: N818  # no error
    """The runs were stopped before all of them had ended."""


@dataclass(frozen=True)
class Evaluator:
    """Walks runs and measures them. The result depends on the runs only, not on who walks them.

    Args:
        start: what is tuned.
        workers: number of threads in this process.
        client: client of a Dask cluster that walks the runs instead.
        stop: asked a few times a second; True ends the work.
    """

    start: Start
    workers: int = 1
    client: Any = None
    stop: Stop = lambda: False

    def __call__(self, tasks: Sequence[Task]) -> list[Measured]:
        """What is measured of each run, in their order.

        Raises:
            Stopped: ``stop`` ended the work.
            ValueError: an experiment that cannot be run.
        """
        if self.client is None:
            return _walked(self.start, tasks, self.workers, self.stop)
        chunks = [tasks[at : at + CHUNK] for at in range(0, len(tasks), CHUNK)]
        sent = [self.client.submit(_walked, self.start, chunk, pure=False) for chunk in chunks]
        while not all(future.done() for future in sent):
            if self.stop():
                self.client.cancel(sent)
                raise Stopped
            self._wait(sent)
        return [each for future in sent for each in future.result()]

    @staticmethod
    def _wait(sent: Sequence[Any]) -> None:
        from dask import distributed  # noqa: PLC0415  # an extra

        wait: Any = distributed.wait
        with suppress(TimeoutError):
            wait([f for f in sent if not f.done()], timeout=0.2, return_when="FIRST_COMPLETED")


def _walked(
    start: Start, tasks: Sequence[Task], workers: int = 1, stop: Stop = lambda: False
) -> list[Measured]:
    def measure(index: int, record: Record) -> Measured:
        return measured_of_paper(start, tasks[index], record)

    found: list[Measured | None] = [None] * len(tasks)
    experiments = [task.experiment for task in tasks]
    for index, result in walk_many(experiments, measure, workers=workers, stop=stop):
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
def cluster(scheduler: str | None) -> Iterator[Any]:
    """Client of the Dask scheduler at an address; None without one.

    Raises:
        ValueError: a missing extra, or no scheduler at the address.
    """
    if scheduler is None:
        yield None
        return
    from apnc.studies.workers import client  # noqa: PLC0415  # takes long to import

    with client(scheduler) as found:
        yield found
