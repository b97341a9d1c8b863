"""Walks from all starts, in processes of this machine; each result is kept when its walk ends."""

from __future__ import annotations

import csv
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from itertools import islice
from pathlib import Path
from typing import Any, Final

from apnc.loop.batch import Lanes, Stop, lanes_of
from apnc.loop.engines import COMPILED
from apnc.loop.experiment import Experiment
from apnc.studies.registry import Entry
from apnc.studies.results import Result, columns_of, id_of
from apnc.studies.store import Store
from apnc.studies.study import Trial
from apnc.studies.workers import CHUNK
from research.basin.starts import RANDOM, found_in, outputs_at, phases_of, starts_of, walks_from

ENTRY: Final = Entry("basin", "Where walks end", package="research")

CONTROLLERS: Final = ("apnc", "apc")

SECONDS: Final = 30.0
"""Length of a walk [s]."""

OF_A_GAIT: Final = 10**6
"""Seeds of the first gait with a name begin here, those of the next at twice that."""

RESULTS_FILE: Final = "trials.jsonl"
TABLE_FILE: Final = "trials.csv"


def grid_of(
    robot: str, mis: Sequence[float], states: int, repeats: int, duration: float = SECONDS
) -> list[Trial]:
    """All walks.

    Args:
        robot: its name or file.
        mis: MI of the walks [1].
        states: number of starts at phases by chance.
        repeats: number of starts at each gait with a name, at common phases by chance.
        duration: length of a walk [s].
    """
    n_legs = len(Experiment(robot=robot).description.legs)
    trials = []
    for mi in mis:
        for place, start in enumerate(starts_of(n_legs)):
            count = states if start == RANDOM else repeats
            for seed in range(OF_A_GAIT * place, OF_A_GAIT * place + count):
                for controller in CONTROLLERS:
                    experiment = Experiment(
                        robot=robot, mi=mi, seed=seed, controller=controller,
                        duration=duration, engine=COMPILED,
                    )  # fmt: skip
                    cell: dict[str, Any] = {"controller": controller, "robot": robot}
                    cell |= {"mi": mi, "start": start}
                    cell |= {"seed": seed, "duration": duration}
                    trials.append(Trial(ENTRY, cell, experiment))
    return trials


def results_of(trials: Sequence[Trial]) -> list[Result]:
    """Walk trials that can walk side by side, and say where they ended."""
    starts = [
        outputs_at(e, phases_of(trial.cell["start"], len(e.description.legs), trial.cell["seed"]))
        for trial in trials
        for e in [trial.experiment]
    ]
    results = []
    for index, walk in walks_from([trial.experiment for trial in trials], starts):
        trial = trials[index]
        found = found_in(walk, trial.experiment.description.weight, trial.experiment.Ts)
        results.append({"study": trial.study, "key": trial.id.key, **trial.cell, **found})
    return results


def chunks_of(trials: Sequence[Trial]) -> Iterator[list[Trial]]:
    """Trials that can walk side by side, a few at a time."""
    kinds: dict[Lanes, list[Trial]] = {}
    for trial in trials:
        kinds.setdefault(lanes_of(trial.experiment), []).append(trial)
    for kind in kinds.values():
        for at in range(0, len(kind), CHUNK):
            yield kind[at : at + CHUNK]


def walked(trials: Sequence[Trial], workers: int, stop: Stop) -> Iterator[Result]:
    """Results as walks end. No walk begins after ``stop`` has returned True."""
    left = chunks_of(trials)
    with ProcessPoolExecutor(workers, initializer=_leave_interrupts_to_parent) as executor:
        running: set[Future[list[Result]]] = set()
        while True:
            wanted = 0 if stop() else 2 * workers - len(running)
            running |= {executor.submit(results_of, chunk) for chunk in islice(left, wanted)}
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                yield from future.result()


def _leave_interrupts_to_parent() -> None:
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)


def run(
    trials: Sequence[Trial],
    folder: Path,
    *,
    workers: int = 1,
    resume: bool = False,
    progress: Callable[[int, int], None] = lambda done, total: None,
    stop: Stop = lambda: False,
) -> list[Result]:
    """Walk what has no result in the folder yet, and write the table of all results.

    Args:
        trials: all walks.
        folder: where results are.
        workers: number of processes.
        resume: keep the results that are there.
        progress: called after every walk with those done, and all.
        stop: True ends the work with the results there are.

    Raises:
        ValueError: fewer than one worker, or results in the folder without ``resume``.
    """
    if workers < 1:
        raise ValueError(f"workers = {workers} is not at least 1")
    path = folder / RESULTS_FILE
    if not resume and path.exists() and path.stat().st_size > 0:
        raise ValueError(f"{path} holds walks already; --resume continues them")
    grid = {trial.id: trial for trial in trials}
    with Store(path) as store:
        left = {at: trial for at, trial in grid.items() if at not in store.results}
        progress(len(grid) - len(left), len(grid))
        for result in walked(list(left.values()), workers, stop):
            store.add(result)
            left.pop(id_of(result))
            progress(len(grid) - len(left), len(grid))
    results = [store.results[at] for at in grid if at in store.results]
    with (folder / TABLE_FILE).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns_of(results), lineterminator="\n")
        writer.writeheader()
        writer.writerows(results)
    return results
