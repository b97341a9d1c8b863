"""Up to where does the gait form and carry the robot on, beside both baselines?"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, Final

from apnc import metrics
from apnc.controllers import named_controller
from apnc.loop.experiment import Experiment
from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.studies.plots import LOOKS
from apnc.studies.results import SPEED, Result, is_number, successes
from apnc.studies.study import WALK_MI, WALK_S, Study
from apnc.studies.table import markdown
from apnc.walking import MIN_FORWARD
from apnc_plant.robot import load_robot
from research.limits.cases import AS_IT_IS, CASES, LIMITS
from research.registry import STUDIES

ENOUGH: Final = 0.9
"""Share of the runs that must do [1]."""

Row = dict[str, Any]

_loaded = lru_cache(load_robot)


def experiment(controller: str, seed: int, case: str, robot: str = "lilibot") -> Experiment:
    """A walk at the MI of sections 3.1.2 to 3.1.4 of the paper, in a case."""
    own, (limit, value) = _loaded(robot), (CASES[case].limit, CASES[case].value)
    fields: dict[str, Any] = {"robot": robot}
    if limit in LIMITS:
        fields |= LIMITS[limit].fields(own, value, seed)
    return Experiment(controller=controller, seed=seed, mi=WALK_MI, duration=WALK_S, **fields)


def works(result: Result) -> bool:
    """Whether the gait formed by the strict criterion and carried the robot ahead, upright."""
    path, ahead, way = (result.get(n) for n in (SPEED, "forward_speed_m_per_s", "distance_m"))
    if not (is_number(path) and is_number(ahead) and is_number(way)) or not successes([result])[0]:
        return False
    assert path is not None and ahead is not None and way is not None
    limit = LIMITS.get(CASES[result["case"]].limit)
    least = 0.0 if limit is None else limit.least_way
    return bool(path >= metrics.MIN_SPEED and ahead >= MIN_FORWARD * path and way >= least)


def counts(results: Sequence[Result]) -> list[Row]:
    """A row per case and controller: runs, those that work, and those that did not fall."""
    cells: dict[tuple[str, str], list[Result]] = {}
    for result in results:
        cells.setdefault((result["case"], result["controller"]), []).append(result)
    return [
        {
            "limit": CASES[case].limit,
            "value": CASES[case].value,
            "controller": controller,
            "runs": len(own),
            "works": sum(map(works, own)),
            "upright": sum(not result.get("fell") for result in own),
        }
        for (case, controller), own in cells.items()
    ]


def reached(rows: Sequence[Row], limit: str, controller: str, column: str) -> list[Row]:
    """Rows of a limit from the robot as it is up to the last that do, and the first that do not.

    Args:
        rows: of :func:`counts`.
        limit: its name.
        controller: its label.
        column: ``works`` or ``upright``.
    """
    own = [row for row in rows if row["controller"] == controller]
    by_value = {float(row["value"]): row for row in own if row["limit"] == limit}
    found = [row for row in own if row["limit"] == AS_IT_IS]
    found += [by_value[value] for value in LIMITS[limit].values if value in by_value]
    for place, row in enumerate(found):
        if int(row[column]) < ENOUGH * int(row["runs"]):
            return found[: place + 1]
    return found


def _told(rows: Sequence[Row], limit: str, controller: str, column: str) -> str:
    """How far it goes, with counts: ``12 (20/20), not 14 (11/20)``.

    "all" says that it does to the last value, "at least" that harder values were not walked.
    """
    found = reached(rows, limit, controller, column)
    if not found:
        return "not run"

    def text(row: Row) -> str:
        where = AS_IT_IS if row["limit"] == AS_IT_IS else f"{float(row['value']):g}"
        return f"{where} ({row[column]}/{row['runs']})"

    last = found[-1]
    if int(last[column]) >= ENOUGH * int(last["runs"]):
        whole = float(last["value"]) == LIMITS[limit].values[-1]
        return f"{'all, to' if whole else 'at least'} {text(last)}"
    return f"{text(found[-2])}, not {text(last)}" if len(found) > 1 else f"no: {text(last)}"


def counts_table(rows: Sequence[Row], column: str = "works") -> str:
    """A line per limit, a column per controller: up to which value it does."""
    controllers = list(dict.fromkeys(row["controller"] for row in rows))
    return markdown(
        {"limit": name, "unit": limit.unit}
        | {named_controller(c).name: _told(rows, name, c, column) for c in controllers}
        for name, limit in LIMITS.items()
        if any(row["limit"] == name for row in rows)
    )


def figures(results: Sequence[Result]) -> list[Figure]:
    """A figure per limit: share of the runs that work over its value."""
    rows = counts(results)
    found = []
    for name, limit in LIMITS.items():
        if not any(row["limit"] == name for row in rows):
            continue
        layout = theme.layout(
            260,
            xaxis=theme.axis(f"{name} [{limit.unit}]"),
            yaxis=theme.axis("runs that work [%]", range=[-4, 104]),
            hovermode="closest",
        )
        if limit.values[0] > limit.values[-1]:
            layout["xaxis"]["autorange"] = "reversed"
        key = f"limits-{name.replace(' ', '-')}"
        note = "Runs in which the gait forms by the strict criterion and carries the robot ahead."
        data = lines_of(rows, name)
        found.append(Figure(key, name.capitalize(), note, data, layout, over_time=False))
    return found


def lines_of(rows: Sequence[Row], limit: str) -> list[Trace]:
    """Share of the runs that work [%] over the value of a limit, a line per controller."""
    lines = []
    for controller in dict.fromkeys(row["controller"] for row in rows):
        own = [r for r in rows if r["controller"] == controller and r["limit"] == limit]
        look = LOOKS[controller]
        lines.append({
            "type": "scatter",
            "mode": "lines+markers",
            "name": named_controller(controller).name,
            "x": [float(row["value"]) for row in own],
            "y": [100.0 * int(row["works"]) / int(row["runs"]) for row in own],
            "line": {"color": look.colour},
            "marker": {"color": look.colour, "symbol": look.symbol, "size": 8},
        })  # fmt: skip
    return lines


STUDY: Final = Study(
    STUDIES["limits"],
    experiment,
    {"case": tuple(CASES)},
    controllers=("apnc", "tegotae_best", "phase_reset_best"),
    figures=figures,
    table=lambda results: counts_table(counts(results)),
)
