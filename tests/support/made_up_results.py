"""Results of studies that nobody ran: every cell of a grid with figures by formula."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import Any

from apnc.controllers import ALL
from apnc.studies.results import Result
from apnc.studies.study import Trial

Figures = Callable[[Result], Result]


def made_up(
    axes: Mapping[str, Sequence[Any]],
    figures: Figures,
    controllers: Sequence[str] = ALL,
    seeds: int = 6,
    study: str = "mi",
) -> list[Result]:
    """A result per value of every axis, seed and controller, with the figures of its cell."""
    results = []
    for values in product(*axes.values()):
        for seed in range(seeds):
            for controller in controllers:
                cell = {
                    "controller": controller,
                    **dict(zip(axes, values, strict=True)),
                    "seed": seed,
                }
                result = {
                    "study": study,
                    "key": f"{len(results):016x}",
                    "mi": 0.08,
                    "duration": 45.0,
                }
                end = {"fell": False, "version": "0", "end": "complete", "error": ""}
                results.append(result | cell | end | figures(cell))
    return results


def quick(trial: Trial) -> Result:
    """The result of a trial that is not run."""
    rest = {"version": "0", "fell": False, "end": "complete", "error": ""}
    return {"study": trial.study, "key": trial.id.key, **trial.cell, **rest}
