"""Is the gait tuned to one body? Every uncertain number of a robot is off by chance at once.

The seed of a walk chooses the body, so a body at 30 % is the one at 5 % with six times the errors.
The controller keeps all its numbers, also the weight of the robot that it was set up for.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any, Final

import numpy as np

from apnc.controllers import named_controller
from apnc.loop.experiment import Experiment
from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.studies.plots import LOOKS
from apnc.studies.results import Result, cells_in, controllers_in, matching, successes
from apnc.studies.statistics import Rate, rate
from apnc.studies.study import Study
from apnc.studies.table import markdown
from apnc.varied import varied
from apnc_plant.robot import RobotDescription, load_robot
from research.registry import STUDIES
from research.robustness.walks import SECONDS, WALKS

SHARES: Final = (0.0, 0.05, 0.1, 0.2, 0.3)
"""How far every number is off at most [1]."""

EVERY: Final = "all walks"
"""In place of a walk: a body counts that forms the gait in every one."""

Row = dict[str, Any]


nominal = lru_cache(load_robot)
"""The robot of a name or file as it is; reading a file takes longer than all the rest."""


@cache  # a body walks many times
def body(robot: str, share: float, seed: int) -> RobotDescription:
    """The robot with every uncertain number off by at most ``share``."""
    return varied(nominal(robot), share, np.random.default_rng(seed))


def experiment(
    controller: str, seed: int, share: float, walk: str, robot: str = "lilibot"
) -> Experiment:
    """A walk of a varied body under the controller of the robot as it is."""
    return Experiment(
        robot=body(robot, share, seed),
        controller=controller,
        seed=seed,
        settings={"robot_weight": nominal(robot).weight},
        duration=SECONDS,
        **WALKS[walk],
    )


def counts(results: Sequence[Result]) -> list[Row]:
    """How many bodies formed the gait by the strict criterion: a row per share, controller, walk.

    The last walk of each is ``EVERY``, over the bodies that did all of them.
    """
    rows = []
    for share in cells_in(results, "share"):
        for controller in controllers_in(results):
            own = matching(results, share=share, controller=controller)
            walks = [walk for walk in WALKS if matching(own, walk=walk)]
            formed: dict[int, list[bool]] = {}
            for walk in walks:
                here = matching(own, walk=walk)
                outcomes = successes(here)
                for result, strict in zip(here, outcomes, strict=True):
                    formed.setdefault(result["seed"], []).append(strict)
                rows.append(_row(share, controller, walk, outcomes))
            whole = [all(each) for each in formed.values() if len(each) == len(walks)]
            rows.append(_row(share, controller, EVERY, whole))
    return rows


def _row(share: float, controller: str, walk: str, outcomes: Sequence[bool]) -> Row:
    cell = {"share": share, "controller": controller, "walk": walk}
    return cell | {"bodies": len(outcomes), "strict": sum(outcomes)}


def rate_of(row: Row) -> Rate:
    """The share of bodies that formed the gait, with its interval."""
    strict = int(row["strict"])
    return rate([True] * strict + [False] * (int(row["bodies"]) - strict))


def counts_table(rows: Sequence[Row]) -> str:
    """A line per share and controller: bodies that formed the gait in each walk and in all."""
    lines: dict[tuple[float, str], dict[str, str]] = {}
    for row in rows:
        share, label = float(row["share"]), row["controller"]
        head = {"off by at most": f"{100 * share:g} %", "controller": named_controller(label).name}
        lines.setdefault((share, label), head)[row["walk"]] = str(rate_of(row))
    return markdown(lines.values())


def shares_formed(rows: Sequence[Row], walk: str = EVERY) -> list[Trace]:
    """Share of bodies that formed the gait [%] over how far their numbers are off [%].

    Args:
        rows: of :func:`counts`.
        walk: the walk, or ``EVERY``.
    """
    traces = []
    for controller in dict.fromkeys(row["controller"] for row in rows):
        own = [row for row in rows if row["controller"] == controller and row["walk"] == walk]
        rates = [rate_of(row) for row in own]
        look = LOOKS[controller]
        bar = {
            "type": "data",
            "symmetric": False,
            "array": [100.0 * (each.high - each.value) for each in rates],
            "arrayminus": [100.0 * (each.value - each.low) for each in rates],
        }
        traces.append({
            "type": "scatter",
            "mode": "lines+markers",
            "name": f"{named_controller(controller).name}, {walk}",
            "x": [100.0 * float(row["share"]) for row in own],
            "y": [100.0 * each.value for each in rates],
            "error_y": bar,
            "line": {"color": look.colour, "dash": "solid" if walk == EVERY else "dot"},
            "marker": {"color": look.colour, "symbol": look.symbol, "size": 9},
        })  # fmt: skip
    return traces


def figures(results: Sequence[Result]) -> list[Figure]:
    """The share of bodies that formed the gait in every walk."""
    layout = theme.layout(
        340,
        xaxis=theme.axis("every uncertain number is off by at most [%]"),
        yaxis=theme.axis("bodies with a strict gait [%]", range=[-4, 104]),
        hovermode="closest",
    )
    note = f"In {', '.join(WALKS)}. Bars are 95 % intervals."
    data = shares_formed(counts(results))
    return [Figure("robustness", "Bodies that form the gait", note, data, layout, over_time=False)]


STUDY: Final = Study(
    STUDIES["robustness"],
    experiment,
    {"share": SHARES, "walk": tuple(WALKS)},
    controllers=("apnc", "apc"),
    figures=figures,
    table=lambda results: counts_table(counts(results)),
)
