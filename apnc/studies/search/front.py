"""``python -m apnc.studies.search.front LOG ... --output front.csv``: the Pareto front of searches.

The best candidates of the logs, by their costs of formation and of feet, walk again with the same
seeds and are measured as in the study ``gait``. The Pareto front holds the candidates that no other
dominates in the five measures of ``BETTER``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Final

import numpy as np
import typer
from numpy.typing import ArrayLike, NDArray

from apnc.features import walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.many import walk_many
from apnc.loop.record import Record
from apnc.studies import gait
from apnc.studies.results import Result
from apnc.studies.search.command import run, tracked
from apnc.studies.search.design import Candidate, built_robot, design_variables, gains, start
from apnc.studies.search.log import keep_logs, read_log, write_table
from apnc.studies.study import SCHEDULE_MI, WALK_MI
from apnc_plant.robot import load_robot

MI_VALUES: Final = (0.06, WALK_MI, 0.10, 0.12, SCHEDULE_MI, 0.20, 0.28, 0.34, 0.40)
WALK_S: Final = 25.0

SHIPPED: Final = "shipped"

BETTER: Final = {"strict": 1, "payload": 1, "lift_mm": 1, "ratio": 1, "turn_deg": -1}
"""Measures of the Pareto front: 1 if more is better, -1 if less."""


def best_ranks(points: ArrayLike, count: int) -> NDArray[np.intp]:
    """The best points by non-dominated sorting.

    Args:
        points: measures of each point, of which smaller is better, shape (n, k).
        count: number of points; all if there are fewer.

    Returns:
        Their indices by rank, and within a rank by the first measure.
    """
    values = np.asarray(points, dtype=np.float64)
    left, found = np.arange(len(values)), np.empty(0, dtype=np.intp)
    while len(left) and len(found) < count:
        layer = left[non_dominated(values[left])]
        found = np.concatenate([found, layer[np.argsort(values[layer, 0], kind="stable")]])
        left = np.setdiff1d(left, layer)
    return found[:count]


def non_dominated(points: ArrayLike) -> NDArray[np.bool_]:
    """Whether each point is on the Pareto front, shape (n,).

    A point is dominated if another is no worse in all measures and better in one.

    Args:
        points: measures of each point, of which smaller is better, shape (n, k).
    """
    p = np.asarray(points, dtype=np.float64)
    no_worse = (p[:, None] <= p).all(axis=2)
    better = (p[:, None] < p).any(axis=2)
    return np.asarray(~(no_worse & better).any(axis=0))


def candidates_of(logs: Sequence[Path], count: int, robot: str) -> dict[str, Candidate]:
    """The candidates of the logs that are best in formation and in feet, by log and line.

    Raises:
        ValueError: a file that is no log of a search for APNC on this robot.
    """
    names = [variable.name for variable in design_variables(robot, "apnc")]
    tried: dict[str, Candidate] = {}
    points = []
    for log in logs:
        columns, lines = read_log(log, names)
        of_costs = [name for name in columns if name.startswith("cost_")]
        for line in lines:
            if line.is_mean:
                continue
            costs = line.numbers(of_costs)
            feet = sum(v for name, v in costs.items() if "feet" in name or "ratio" in name)
            points.append((sum(costs.values()) - feet, feet))
            tried[f"{log.parent.name}:{line.number}"] = line.numbers(names)
    labels = list(tried)
    return {labels[n]: tried[labels[n]] for n in best_ranks(points, count)}


def walks_of(candidate: Candidate, robot: str, seeds: int) -> list[Experiment]:
    """Walks of a candidate: ``seeds`` at every MI, then twice as many with payload."""
    what: dict[str, Any] = {
        "robot": built_robot(candidate, robot),
        "settings": gains(candidate),
        "duration": WALK_S,
    }
    over_mi = [Experiment(mi=mi, seed=seed, **what) for mi in MI_VALUES for seed in range(seeds)]
    loaded = {"mi": WALK_MI, "conditions": "C4", **what}
    return over_mi + [Experiment(seed=seed, **loaded) for seed in range(2 * seeds)]


def result_of(record: Record) -> Result:
    """Figures of one walk."""
    return walk_features(record).to_dict() | gait.measure(record)


def measured(walks: Sequence[Result], seeds: int) -> dict[str, float]:
    """Measures of a candidate.

    Args:
        walks: measures of its walks, in the order of :func:`walks_of`.
        seeds: number of seeds at every MI.
    """
    results = {mi: walks[n * seeds : (n + 1) * seeds] for n, mi in enumerate(MI_VALUES)}
    loaded = walks[len(MI_VALUES) * seeds :]
    low = [_median(own, gait.LIFT, 0.0) for own in results.values()]
    slip = [_median(own, gait.SLIP, 1.0) for own in results.values()]
    turn = [_median(own, "turned_deg", 360.0, abs) * 45.0 / WALK_S for own in results.values()]
    strict = [result["converged"] is True for own in results.values() for result in own]
    speed = {
        mi: _median(results[mi], "late_speed_m_per_s", 0.0) for mi in (SCHEDULE_MI, MI_VALUES[-1])
    }
    return {
        "strict": float(np.mean(strict)),
        "payload": float(np.mean([result["converged"] is True for result in loaded])),
        "lift_mm": float(np.mean(low)),
        "least_lift_mm": min(low),
        "lifts": sum(value >= 6.0 for value in low),
        "holds": sum(value <= 0.12 for value in slip),
        "turn_deg": float(np.median(turn)),
        "ratio": speed[MI_VALUES[-1]] / speed[SCHEDULE_MI] if speed[SCHEDULE_MI] > 0.0 else 0.0,
    }


def walked(
    tried: Mapping[str, Candidate], robot: str, seeds: int, workers: int
) -> Iterator[tuple[str, dict[str, float]]]:
    """Label and measures of candidates, as their walks end. All walk side by side."""
    walks = {label: walks_of(candidate, robot, seeds) for label, candidate in tried.items()}
    places = [(label, n) for label, own in walks.items() for n in range(len(own))]
    results: dict[str, dict[int, Result]] = {label: {} for label in tried}
    every = [experiment for own in walks.values() for experiment in own]
    for at, result in walk_many(every, lambda _, record: result_of(record), workers=workers):
        if isinstance(result, Exception):
            raise result
        label, n = places[at]
        results[label][n] = result
        if len(results[label]) == len(walks[label]):
            own = results.pop(label)
            yield label, measured([own[n] for n in range(len(own))], seeds)


def _median(
    results: Sequence[Mapping[str, Any]],
    name: str,
    missing: float,
    of: Callable[[float], float] = lambda value: value,
) -> float:
    return float(
        np.median([missing if result[name] is None else of(result[name]) for result in results])
    )


def front(
    logs: Annotated[
        list[Path], typer.Argument(help="Files search.csv of searches for the same robot.")
    ],
    output: Annotated[Path, typer.Option(help="File for measures and values.")] = Path("front.csv"),
    robot: Annotated[str, typer.Option(help="Robot name.")] = "lilibot",
    count: Annotated[int, typer.Option(min=1, help="Number of candidates that walk again.")] = 40,
    seeds: Annotated[int, typer.Option(min=1, help="Seeds at every MI.")] = 3,
    workers: Annotated[int, typer.Option(min=1, help="Number of threads.")] = 1,
) -> None:
    """Walk the best candidates again and write their measures, with the Pareto front marked.

    An interrupted run writes the candidates that have walked.
    """
    keep_logs(output, logs)
    tried = candidates_of(logs, count, robot)
    shipped = load_robot(robot)
    names = [variable.name for variable in design_variables(robot, "apnc")]
    tried = {SHIPPED: {name: start(shipped, name) for name in names}, **tried}
    found: dict[str, dict[str, float]] = {}
    try:
        done = walked(tried, robot, seeds, workers)
        for label, figures in tracked(done, len(tried), "candidates"):
            found[label] = figures
    finally:
        _write(output, tried, found)


def _write(
    output: Path, tried: Mapping[str, Candidate], found: Mapping[str, dict[str, float]]
) -> None:
    if not found:
        return
    labels = [label for label in tried if label in found]
    best = non_dominated(
        [[-sign * found[x][name] for name, sign in BETTER.items()] for x in labels]
    )
    table = [["candidate", "front", *found[labels[0]], *tried[labels[0]]]]
    for label, on_it in zip(labels, best, strict=True):
        values = [f"{value:.5g}" for value in (*found[label].values(), *tried[label].values())]
        table.append([label, str(int(on_it)), *values])
    write_table(output, table)


if __name__ == "__main__":
    run(front)
