"""Many closed loops at once: batches of runs in C on the threads of this process."""

from __future__ import annotations

import queue
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, Final, TypeVar

from apnc.loop.batch import Batch, Lanes, Run, Stop, contacts_of, lanes_of
from apnc.loop.engines import COMPILED
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record

Found = TypeVar("Found")

_POLL_S: Final = 0.1
"""How often ``stop`` is asked while nothing ends [s]."""

_TICKS: Final = 2**30
"""More ticks than any run has, so that a batch walks until a run has ended."""

_BROKEN: Final = -1
"""In place of the index of an experiment: the error is not one of an experiment."""


def walk_many(
    experiments: Sequence[Experiment],
    each: Callable[[int, Record], Found],
    *,
    workers: int = 1,
    stop: Stop = lambda: False,
    signals: frozenset[str] | None = None,
) -> Iterator[tuple[int, Found | Exception]]:
    """Walk experiments and yield what ``each`` makes of every record, as the runs finish.

    Args:
        experiments: what is run.
        each: function of index and record. It is called in the thread that walked the run, one call
            at a time per thread.
        workers: number of threads.
        stop: asked a few times a second; True ends the work.
        signals: names of the signals that ``each`` needs; a record then holds these, the inputs and
            the commands of the controller, and no parameters, and takes less time. None: all.

    Yields:
        Index of an experiment, and its result or the exception that ended it.

    Raises:
        ValueError: fewer than one worker, or a missing controller.
    """
    if workers < 1:
        raise ValueError(f"workers = {workers} is not at least 1")
    experiments = [compiled(experiment) for experiment in experiments]
    yield from _Work(experiments, each, signals).results(min(workers, len(experiments)), stop)


class _Group:
    """Experiments that can walk side by side.

    Attributes:
        lanes: properties that they have in common.
        contacts: largest number of contacts of a foot with any of their grounds.
        left: indices of those that no thread has taken.
        threads: number of threads that walk some of them.
    """

    def __init__(self, experiments: Sequence[Experiment], lanes: Lanes, those: list[int]) -> None:
        self.lanes, self.threads = lanes, 0
        self.contacts = contacts_of([experiments[index] for index in those])
        # the longest first, or a thread would walk them alone at the end
        self.left = deque(sorted(those, key=lambda index: -experiments[index].ticks))


class _Work:
    """The runs that are left, shared by the threads.

    Threads suffice, since C walks without the interpreter's lock. Python needs the lock to prepare
    a run and to take its measures, about as long as C walks it. So more than two threads wait for
    each other.
    """

    def __init__(
        self,
        experiments: Sequence[Experiment],
        each: Callable[[int, Record], object],
        signals: frozenset[str] | None,
    ) -> None:
        self._experiments, self._each, self._signals = experiments, each, signals
        those: dict[Lanes, list[int]] = {}
        for index, experiment in enumerate(experiments):
            those.setdefault(lanes_of(experiment), []).append(index)
        self._groups = [_Group(experiments, *group) for group in those.items()]
        self._lock = threading.Lock()
        self._found: queue.SimpleQueue[tuple[int, object]] = queue.SimpleQueue()
        self._batches: set[Batch] = set()

    def results(self, workers: int, stop: Stop) -> Iterator[tuple[int, Any]]:
        threads = [threading.Thread(target=self._work, daemon=True) for _ in range(workers)]
        for thread in threads:
            thread.start()
        missing = len(self._experiments)
        try:
            while missing and not stop():
                try:
                    index, found = self._found.get(timeout=_POLL_S)
                except queue.Empty:
                    continue
                if index == _BROKEN:
                    raise found  # type: ignore[misc]  # an exception
                missing -= 1
                yield index, found
        finally:
            self._stop()
            for thread in threads:
                thread.join()

    def _stop(self) -> None:
        with self._lock:
            for group in self._groups:
                group.left.clear()
            for batch in self._batches:
                batch.stop()

    def _work(self) -> None:
        try:
            while (group := self._join()) is not None:
                self._walk(group)
                group.threads -= 1
        except BaseException as error:  # not of an experiment: all of the work ends with it
            self._found.put((_BROKEN, error))

    def _join(self) -> _Group | None:
        """The group to walk next, if possible one without a thread, so that all lanes are used."""
        with self._lock:
            waiting = [group for group in self._groups if group.left]
            if not waiting:
                return None
            group = min(waiting, key=lambda group: (group.threads, -len(group.left)))
            group.threads += 1
            return group

    def _walk(self, group: _Group) -> None:
        """Walk what is left of a group side by side. An error in one run ends no other."""
        try:
            batch = Batch(
                group.lanes,
                group.contacts,
                single=len(group.left) == 1,
                signals=self._signals,
            )
        except ValueError as error:  # the controller cannot be used
            while (index := self._next(group)) is not None:
                self._found.put((index, error))
            return
        with self._lock:
            self._batches.add(batch)
        walking: dict[Run, int] = {}
        try:
            while True:
                while batch.free and (index := self._next(group)) is not None:
                    self._begin(batch, index, walking)
                if not walking:
                    return
                ended = batch.walk(_TICKS)
                if not ended:  # stopped
                    return
                while ended:  # each is forgotten at once: its record takes megabytes
                    self._tell(walking.pop(ended[-1]), ended.pop())
        finally:
            with self._lock:
                self._batches.remove(batch)
            batch.close()

    def _next(self, group: _Group) -> int | None:
        with self._lock:
            return group.left.popleft() if group.left else None

    def _begin(self, batch: Batch, index: int, walking: dict[Run, int]) -> None:
        try:
            run = Run(self._experiments[index], batch.controller, self._signals)
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
