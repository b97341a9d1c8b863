"""Many walks at once, measured."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, overload

from apnc.features import WalkFeatures, walk_features
from apnc.loop.batch import Stop
from apnc.loop.experiment import Experiment
from apnc.loop.many import walk_many
from apnc.loop.of_robot import warn_of_mi
from apnc.loop.record import Record


@overload
def simulate_many(
    experiments: Sequence[Experiment],
    *,
    workers: int = 1,
    records: Literal[False] = False,
    progress: Callable[[int, int], None] = ...,
    stop: Stop = ...,
) -> list[WalkFeatures | None]: ...


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
) -> list[WalkFeatures | None] | list[Record | None]:
    """Walk many experiments in C, several robots side by side.

    Every run has the same bits as ``simulate`` with ``engine="compiled"``, whatever walks beside
    it. An experiment that names another engine walks in C as well; its summary or record says so.

    Args:
        experiments: what is run.
        workers: number of threads; best is the number of cores.
        records: return whole records instead of summaries. A record of 45 s takes 3.5 MB.
        progress: called after every run with the number of runs done and of all.
        stop: asked a few times a second; True ends the work.

    Returns:
        A summary, or a record, per experiment, in their order; None for those not done when
        ``stop`` ended the work.

    Raises:
        ValueError: fewer than one worker, a controller that cannot be used, or one that refused.
    """
    warn_of_mi(experiments)
    found: list[WalkFeatures | Record | None] = [None] * len(experiments)
    done = 0

    def keep(index: int, record: Record) -> WalkFeatures | Record:
        return record if records else walk_features(record)

    for index, result in walk_many(experiments, keep, workers=workers, stop=stop):
        if isinstance(result, Exception):
            raise result
        found[index], done = result, done + 1
        progress(done, len(experiments))
    return found  # type: ignore[return-value]  # one kind of them
