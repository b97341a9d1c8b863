"""The search: CMA-ES over the design variables, with a check of its favourite now and then."""

from __future__ import annotations

import importlib
import math
import time
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from apnc.extras import missing
from apnc.tune.costs import total, weights_of
from apnc.tune.design import Candidate, Start, candidate
from apnc.tune.evaluate import Evaluator, Stopped, extra_of, seconds
from apnc.tune.log import Log
from apnc.tune.measured import Measured
from apnc.tune.runs import of_check
from apnc_core.types import Array

CANDIDATES: Final = 16
"""Number of candidates in a generation."""

CANDIDATES_OF_PAPER: Final = 32
"""The same if the paper's experiments are judged: more chance is in so many runs."""

SIGMA: Final = 0.15
"""First standard deviation, as a share of each range."""

NEAR_SIGMA: Final = 0.05
"""First standard deviation of a search that stays near its start, as a share of each range."""

SCOUTS: Final = 4
"""Generations at the beginning that look around the start; the search begins at their best."""

SCOUT_SIGMA: Final = 0.25
"""Standard deviation of their candidates, as a share of each range."""

CHECK_EVERY: Final = 4
"""Generations from one check of the favourite to the next."""


@dataclass(frozen=True)
class Best:
    """The best candidate so far.

    Args:
        x: its point, a coordinate in [0, 1] for each variable.
        candidate: its robot.
        runs: what was measured in its check.
        cost: of these runs.
    """

    x: tuple[float, ...]
    candidate: Candidate
    runs: tuple[Measured, ...]
    cost: float


@dataclass
class Count:
    """How much was tried.

    Args:
        generations, candidates: number of them.
        simulated: time that robots walked [s].
        wall: time that it took [s].
        resumed: number of candidates whose cost the log had.
        checked: number of candidates before the last check; that many find the same best again.
    """

    generations: int = 0
    candidates: int = 0
    simulated: float = 0.0
    wall: float = 0.0
    resumed: int = 0
    checked: int = 0
    begun: float = field(default_factory=time.perf_counter)


Told = Callable[[Best, Count], None]
"""Called after every generation."""


def search(
    start: Start,
    evaluator: Evaluator,
    log: Log,
    *,
    seed: int,
    candidates: int | None = None,
    progress: Told = lambda best, count: None,
) -> tuple[Best, Count]:
    """Search until enough candidates were tried or the evaluator is stopped.

    The same seed gives the same candidates, whoever walks them. A log of an earlier search is read
    first: its costs stand for runs that need not be walked again.

    Args:
        start: what is tuned.
        evaluator: walks the runs.
        log: where every candidate and its cost is written.
        seed: of the optimiser and all runs.
        candidates: number of candidates to try; None: until the evaluator is stopped.
        progress: called after the first check and after every generation.

    Returns:
        The best candidate and how much was tried.

    Raises:
        ValueError: the log is of another search.
        RuntimeError: the package ``cma`` is missing.
    """
    count = Count()
    checks = _Checks(start, evaluator, count)
    strategy = _Strategy(start, seed)
    try:
        best = checks.of(start.first(), log)
        progress(best, count)
        while candidates is None or count.candidates < candidates:
            points = strategy.ask()
            costs = log.costs(count.generations, points)
            if costs is None:
                # scouts walk the same runs, so that their costs can be compared
                number = count.generations if start.near else max(count.generations, SCOUTS)
                costs, simulated = evaluator.costs(points, 1000 * seed + number)
                count.simulated += simulated
                log.write(count.generations, points, costs)
            else:
                count.resumed += len(points)
            strategy.tell(points, costs)
            count.generations += 1
            count.candidates += len(points)
            last = candidates is not None and count.candidates >= candidates
            if count.generations % CHECK_EVERY == 0 or last:
                found = checks.of(strategy.favourite, log)
                best = min(best, found, key=lambda each: each.cost)
            count.wall = time.perf_counter() - count.begun
            progress(best, count)
    except Stopped:
        if checks.best is None:
            raise
        best = checks.best
    count.wall = time.perf_counter() - count.begun
    return best, count


class _Checks:
    """Checks of favourites, and the best of them."""

    def __init__(self, start: Start, evaluator: Evaluator, count: Count) -> None:
        self._start, self._evaluator, self._count = start, evaluator, count
        self.best: Best | None = None

    def of(self, x: Sequence[float], log: Log) -> Best:
        """Check a point. One that the log has checked and found worse is not walked again."""
        found = candidate(self._start, x)
        known = log.check(self._count.generations)
        if known is not None and self.best is not None and known >= self.best.cost:
            self._count.checked = self._count.candidates
            return self.best
        tasks = of_check(self._start, found, extra=extra_of(self._start))
        runs = tuple(self._evaluator(tasks))
        self._count.simulated += seconds(tasks)
        checked = Best(
            tuple(map(float, x)), found, runs, total(tasks, runs, weights_of(self._start))
        )
        log.write_check(self._count.generations, checked.cost)
        self._count.checked = self._count.candidates
        if self.best is None or checked.cost < self.best.cost:
            self.best = checked
        return checked


class _Strategy:
    """Scouts around the start; then CMA-ES, which begins at the best of them.

    A search that stays near its start has no scouts and smaller steps.

    When it has converged, it begins anew around its favourite, with more candidates.
    """

    def __init__(self, start: Start, seed: int) -> None:
        try:
            with warnings.catch_warnings():  # of plots, which nobody asks for here
                warnings.simplefilter("ignore")
                self._cma: Any = importlib.import_module("cma")
        except ModuleNotFoundError:
            raise RuntimeError(missing("cma", "tune")) from None
        self._seed = seed
        self._size = CANDIDATES_OF_PAPER if start.paper else CANDIDATES
        self.favourite: list[float] = start.first()
        self._sigma = NEAR_SIGMA if start.near else SIGMA
        self._scouts, self._least = 0 if start.near else SCOUTS, math.inf
        self._rng, self._first = np.random.default_rng(seed), np.array(self.favourite)
        self._now: Any = None

    def _begin(self) -> None:
        options = {
            "bounds": [0.0, 1.0], "seed": self._seed, "popsize": self._size, "verbose": -9,
        }  # fmt: skip
        self._now = self._cma.CMAEvolutionStrategy(self.favourite, self._sigma, options)

    def ask(self) -> list[Array]:
        """Points of the next generation."""
        if self._scouts:
            steps = SCOUT_SIGMA * self._rng.normal(size=(self._size, len(self._first)))
            if self._scouts == SCOUTS:
                steps[0] = 0.0
            return list(np.clip(self._first + steps, 0.0, 1.0))
        if self._now is None:
            self._begin()
        elif self._now.stop():
            self._seed += 1
            self._size = round(1.5 * self._size)
            self._begin()
        points: list[Array] = self._now.ask()
        return points

    def tell(self, points: Sequence[Array], costs: Sequence[float]) -> None:
        """Costs of the points."""
        if self._scouts:
            self._scouts -= 1
            best = int(np.argmin(costs))
            if costs[best] < self._least:
                self._least, self.favourite = costs[best], [float(x) for x in points[best]]
            return
        self._now.tell(points, costs)
        self.favourite = [min(max(float(x), 0.0), 1.0) for x in self._now.result.xfavorite]
