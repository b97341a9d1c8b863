"""Many closed loops at once: batches of lanes in C, on threads of this process."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Final, Literal, TypeVar, overload

from apnc.loop.batch import Batch, Lanes, Run, contacts_of, lanes_of
from apnc.loop.controller_library import controller_library
from apnc.loop.engines import COMPILED
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.summary import Summary, summarise

Result = TypeVar("Result")
Stop = Callable[[], bool]

_POLL_S: Final = 0.1
"""How often ``stop`` is asked while nothing ends [s]."""

_TICKS: Final = 2**30
"""More than any run has: lanes walk until one of them has ended."""


@overload
def simulate_many(
    experiments: Sequence[Experiment],
    *,
    workers: int = 1,
    records: Literal[False] = False,
    progress: Callable[[int, int], None] = ...,
    stop: Stop = ...,
) -> list[Summary | None]: ...


@overload
def simulate_many(
    experiments: Sequence[Experiment],
    *,
    workers: int = 1,
    records: Literal[True],
    progress: Callable[[int, int], None] = ...,
    stop: Stop = ...,
) -> list[Record | None]: ...


def simulate_many(
    experiments: Sequence[Experiment],
    *,
    workers: int = 1,
    records: bool = False,
    progress: Callable[[int, int], None] = lambda done, total: None,
    stop: Stop = lambda: False,
) -> list[Summary | None] | list[Record | None]:
    """Walk many experiments in C, several robots side by side.

    Each walks as ``simulate`` walks it with ``engine="compiled"``, bit for bit, whatever walks
    beside it. An experiment that names another engine is walked in C all the same, and its summary
    or record says so.

    Args:
        experiments: what is run.
        workers: threads, at best as many as there are cores.
        records: return whole records instead of summaries. A record of 45 s takes 3.5 MB.
        progress: called after every run with the number of runs done and of all.
        stop: asked a few times a second; True ends the work.

    Returns:
        A summary, or a record, per experiment, in their order; None for those not done when
        ``stop`` ended the work.

    Raises:
        ValueError: fewer than one worker, a controller that cannot be used, or one that refused.
    """
    found: list[Summary | Record | None] = [None] * len(experiments)
    done = 0
    def keep(index: int, record: Record) -> Summary | Record:
        return record if records else summarise(record)

    for index, result in walk_many(experiments, keep, workers=workers, stop=stop):
        if isinstance(result, Exception):
            raise result
        found[index], done = result, done + 1
        progress(done, len(experiments))
    return found  # type: ignore[return-value]  # one kind of them


def walk_many(
    experiments: Sequence[Experiment],
    each: Callable[[int, Record], Result],
    *,
    workers: int = 1,
    stop: Stop = lambda: False,
) -> Iterator[tuple[int, Result | Exception]]:
    """Walk experiments and give what ``each`` makes of every record, as they finish.

    Args:
        experiments: what is run.
        each: called with index and record in the thread that walked them, one call at a time per
            thread.
        workers: threads.
        stop: asked a few times a second; True ends the work.

    Yields:
        Index of an experiment, and its result or the exception that ended it.

    Raises:
        ValueError: fewer than one worker.
    """
    if workers < 1:
        raise ValueError(f"workers = {workers} is not at least 1")
    experiments = [compiled(experiment) for experiment in experiments]
    groups: dict[Lanes, list[int]] = {}
    for index, experiment in enumerate(experiments):
        groups.setdefault(lanes_of(experiment), []).append(index)
    for lanes, indices in groups.items():
        group = _Group(experiments, indices, lanes, each)
        yield from group.results(min(workers, len(indices)), stop)
        if group.stopped:
            return


class _Group:
    """Experiments that can walk side by side, shared by the threads that walk them."""

    def __init__(
        self,
        experiments: Sequence[Experiment],
        indices: Sequence[int],
        lanes: Lanes,
        each: Callable[[int, Record], Result],
    ) -> None:
        self._experiments, self._lanes, self._each = experiments, lanes, each
        self._contacts = contacts_of([experiments[index] for index in indices])
        self._left, self._lock = iter(indices), threading.Lock()
        self._found: queue.SimpleQueue[tuple[int, object]] = queue.SimpleQueue()
        self._batches: list[Batch] = []
        self.stopped = False
        self._expected = len(indices)

    def results(self, workers: int, stop: Stop) -> Iterator[tuple[int, object]]:
        controller_library(self._lanes.fmu)  # refuses here, not in a thread
        threads = [threading.Thread(target=self._work, daemon=True) for _ in range(workers)]
        for thread in threads:
            thread.start()
        try:
            got = 0
            while got < self._expected:
                try:
                    found = self._found.get(timeout=_POLL_S)
                except queue.Empty:
                    if stop() or not any(thread.is_alive() for thread in threads):
                        break
                    continue
                got += 1
                yield found
                if stop():
                    break
            self.stopped = got < self._expected
        finally:
            self._stop()
            for thread in threads:
                thread.join()

    def _stop(self) -> None:
        with self._lock:
            self._left = iter(())
            for batch in self._batches:
                batch.stop()

    def _next(self) -> int | None:
        with self._lock:
            return next(self._left, None)

    def _work(self) -> None:
        batch = Batch(self._lanes, self._contacts)
        with self._lock:
            self._batches.append(batch)
        walking: dict[Run, int] = {}
        try:
            while True:
                while batch.free and (index := self._next()) is not None:
                    self._begin(batch, index, walking)
                if not walking:
                    return
                ended = batch.walk(_TICKS)
                if not ended:  # stopped
                    return
                for run in ended:
                    self._tell(walking.pop(run), run)
        finally:
            batch.close()

    def _begin(self, batch: Batch, index: int, walking: dict[Run, int]) -> None:
        try:
            run = Run(self._experiments[index], batch.controller)
        except Exception as error:
            self._found.put((index, error))
            return
        walking[run] = index
        batch.begin(run)

    def _tell(self, index: int, run: Run) -> None:
        try:
            self._found.put((index, self._each(index, run.record())))
        except Exception as error:
            self._found.put((index, error))


def compiled(experiment: Experiment) -> Experiment:
    """The same experiment on the robot in C."""
    return experiment if experiment.engine == COMPILED else replace(experiment, engine=COMPILED)
