"""``python -m apnc.studies.search --output runs/search``; needs the extra ``search``.

All runs of a generation walk in C, side by side. Every candidate is written with its costs to
``search.csv``. The same seed gives the same search for any number of workers.
``apnc.studies.search.front`` finds the best candidates of some logs.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from apnc.extras import missing
from apnc.studies.search.command import run, tracked
from apnc.studies.search.costs import costs_of, names
from apnc.studies.search.design import Candidate, DesignVariable, design_variables, start
from apnc.studies.search.log import keep_logs, read_log, write_table
from apnc_core.types import Array
from apnc_plant.robot import load_robot


def search(
    output: Annotated[Path, typer.Option(help="Folder for search.csv.")] = Path("runs/search"),
    robot: Annotated[str, typer.Option(help="Robot name.")] = "lilibot",
    controller: Annotated[
        str, typer.Option(help="Controller: apnc, tegotae, phase_reset.")
    ] = "apnc",
    own_robot: Annotated[
        bool, typer.Option(help="For a baseline, search robot and pose as well.")
    ] = False,
    feet: Annotated[
        float, typer.Option(help="Weight of the costs of lift, slip, touch-downs and turn.")
    ] = 1.0,
    seed: Annotated[  # cma takes 0 for the time of day
        int, typer.Option(min=1, max=2**32 - 1, help="Seed of optimiser and trials.")
    ] = 1,
    generations: Annotated[int, typer.Option(min=1, help="Number of generations.")] = 60,
    candidates: Annotated[
        int, typer.Option(min=2, help="Number of candidates in a generation.")
    ] = 14,
    workers: Annotated[int, typer.Option(min=1, help="Number of threads.")] = 1,
    sigma: Annotated[
        float, typer.Option(help="First standard deviation, as share of each range.")
    ] = 0.15,
    begin: Annotated[
        Path | None, typer.Option(help="Log of a search whose last mean is the start.")
    ] = None,
) -> None:
    """Search, and print the mean of the last distribution.

    Every generation has its own seeds, the same for all of its candidates.
    """
    if not 0.0 < sigma <= 1.0:
        raise ValueError(f"sigma = {sigma}; allowed: above 0, up to 1")
    if not 0.0 <= feet < math.inf:
        raise ValueError(f"feet = {feet}; allowed: a finite number from 0 on")
    path = output / "search.csv"
    keep_logs(path, [begin] if begin else [])
    variables = design_variables(robot, controller, own_robot=own_robot)
    first = [_within(variable.scaled(value)) for variable, value in _begin(robot, variables, begin)]
    strategy = _strategy(first, sigma, seed, candidates)
    output.mkdir(parents=True, exist_ok=True)
    parts = names(len(load_robot(robot).legs))
    weights = [feet if name.startswith("feet") else 1.0 for name in parts]
    columns = [*(f"cost_{name}" for name in parts), *(variable.name for variable in variables)]
    table = [["generation", "cost", *columns]]
    mean: Candidate = {}
    for generation in tracked(range(generations), generations, "generations"):
        points = strategy.ask()
        tried = [_candidate(variables, x) for x in points]
        found = costs_of(tried, 1000 * seed + generation, robot, controller, workers)
        # squares: one large cost weighs more than many small ones
        weighed = np.multiply(found, weights)
        totals = (weighed + weighed**2).sum(axis=1).tolist()
        strategy.tell(points, totals)
        mean = _candidate(variables, strategy.result.xfavorite)
        for candidate, each, total in zip(tried, found, totals, strict=True):
            table.append(_line(str(generation), [total, *each, *candidate.values()]))
        middle = [float(np.median(totals)), *np.median(found, axis=0), *mean.values()]
        table.append(_line(f"mean{generation}", middle))
        # an older log stays until there is something to write, and no kill cuts a line short
        write_table(path, table)
    for name, value in mean.items():
        typer.echo(f"{name} = {value:.4g}")


def _line(generation: str, values: Sequence[float]) -> list[str]:
    return [generation, *(f"{value:.5g}" for value in values)]


def _within(x: float) -> float:
    return min(1.0, max(0.0, x))


def _begin(
    robot: str, variables: Sequence[DesignVariable], log: Path | None
) -> list[tuple[DesignVariable, float]]:
    shipped = load_robot(robot)
    values = {variable.name: start(shipped, variable.name) for variable in variables}
    if log is not None:
        columns, lines = read_log(log)
        means = [line for line in lines if line.is_mean]
        if not means:
            raise ValueError(f"{log} has no mean of a generation; it is no log of a search")
        values |= means[-1].numbers(name for name in values if name in columns)
    return [(variable, values[variable.name]) for variable in variables]


def _strategy(first: Sequence[float], sigma: float, seed: int, candidates: int) -> Any:
    """CMA-ES, or even samples of the range for a single variable, which CMA-ES does not search."""
    if len(first) == 1:
        return Spread(candidates, seed)
    try:
        cma: Any = importlib.import_module("cma")
    except ModuleNotFoundError:
        raise RuntimeError(missing("cma", "search")) from None
    settings = {"bounds": [0.0, 1.0], "seed": seed, "popsize": candidates, "verbose": -9}
    return cma.CMAEvolutionStrategy(first, sigma, settings)


class Spread:
    """Even samples of the range of one variable in every generation, with the interface of ``cma``.

    The favourite has the lowest mean cost over its neighbours of all generations.
    """

    def __init__(self, candidates: int, seed: int) -> None:
        self._count, self._random = candidates, np.random.default_rng(seed)
        self._x: list[float] = []
        self._cost: list[float] = []

    def ask(self) -> list[Array]:
        """A value in every equal part of the range."""
        return [np.array([(n + self._random.random()) / self._count]) for n in range(self._count)]

    def tell(self, points: Sequence[Array], totals: Sequence[float]) -> None:
        """Costs of the values."""
        self._x += [float(point[0]) for point in points]
        self._cost += totals

    @property
    def result(self) -> Spread:
        """This object, which has the favourite."""
        return self

    @property
    def xfavorite(self) -> Array:
        """The value with the lowest mean cost within half a part of the range."""
        x, cost = np.array(self._x), np.array(self._cost)
        near = np.abs(x[:, None] - x) <= 0.5 / self._count
        return np.array([x[np.argmin(near @ cost / near.sum(axis=1))]])


def _candidate(variables: Sequence[DesignVariable], x: Array) -> dict[str, float]:
    return {
        variable.name: variable.value(float(v)) for variable, v in zip(variables, x, strict=True)
    }


if __name__ == "__main__":
    run(search)
