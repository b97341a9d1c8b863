"""``python -m apnc.studies.search --output runs/search``; needs the extra ``search``.

Writes every candidate with its cost to ``search.csv``. The same seed, workers or not, gives the
same search.
"""

from __future__ import annotations

import csv
import importlib
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from apnc.studies.search.costs import COSTS, FAILED, costs
from apnc.studies.search.knobs import KNOBS, Candidate
from apnc.studies.workers import pool
from build_fmu.build import host_fmu


def search(
    output: Annotated[Path, typer.Option(help="Folder for search.csv.")] = Path("runs/search"),
    seed: Annotated[int, typer.Option(help="Of optimiser and trials.")] = 1,
    generations: Annotated[int, typer.Option(help="How many.")] = 60,
    workers: Annotated[int, typer.Option(help="Processes.")] = 1,
    sigma: Annotated[float, typer.Option(help="First spread, share of the ranges.")] = 0.15,
    start: Annotated[Path | None, typer.Option(help="Log whose last mean is the start.")] = None,
) -> None:
    """Search and print the mean of the last distribution.

    Every generation has a new random robot and noise, the same for its candidates.
    """
    try:
        cma: Any = importlib.import_module("cma")
    except ModuleNotFoundError:
        raise RuntimeError('the search needs the extra: pip install "apnc[search]"') from None
    output.mkdir(parents=True, exist_ok=True)
    host_fmu()  # built once here, not by every worker at the same time
    settings = {"bounds": [0.0, 1.0], "seed": seed, "popsize": 14, "verbose": -9}
    strategy: Any = cma.CMAEvolutionStrategy(_start(start), sigma, settings)
    mean: Candidate = {}
    with (
        (output / "search.csv").open("w", newline="", encoding="utf-8") as file,
        pool(workers, None) as executor,
    ):
        log = csv.writer(file)
        parts = [f"cost_{name}" for name in COSTS]
        log.writerow(["generation", "cost", *parts, *(knob.name for knob in KNOBS)])
        for generation in range(generations):
            points = strategy.ask()
            candidates = [_candidate(x) for x in points]
            seeds = [1000 * seed + generation] * len(candidates)
            found = list((executor.map if executor else map)(_costs, candidates, seeds))
            # squares: one large cost weighs more than many small ones
            totals = [sum(cost + cost * cost for cost in each) for each in found]
            strategy.tell(points, totals)
            mean = _candidate(strategy.result.xfavorite)
            middle = [float(np.median(totals)), *np.median(found, axis=0), *mean.values()]
            for candidate, each, total in zip(candidates, found, totals, strict=True):
                row = [total, *each, *candidate.values()]
                log.writerow([generation, *(f"{value:.5g}" for value in row)])
            log.writerow([f"mean{generation}", *(f"{value:.5g}" for value in middle)])
            file.flush()
    for name, value in mean.items():
        typer.echo(f"{name} = {value:.4g}")


def _costs(candidate: Candidate, seed: int) -> tuple[float, ...]:
    try:
        return costs(candidate, seed)
    except (ValueError, RuntimeError):
        return (FAILED,) * len(COSTS)


def _start(log: Path | None) -> list[float]:
    if log is None:
        return [knob.place(knob.start) for knob in KNOBS]
    with log.open(newline="", encoding="utf-8") as file:
        last = [row for row in csv.DictReader(file) if row["generation"].startswith("mean")][-1]
    return [knob.place(float(last[knob.name])) for knob in KNOBS]


def _candidate(x: NDArray[np.float64]) -> dict[str, float]:
    return {knob.name: knob.value(float(v)) for knob, v in zip(KNOBS, x, strict=True)}


if __name__ == "__main__":
    typer.run(search)
