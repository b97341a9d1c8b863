"""How large a push does a walking robot forget? With the stored gait, and with the loads alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.controllers import named_controller
from apnc.loop.experiment import Experiment
from apnc.loop.push import Push
from apnc.loop.record import Record
from apnc.metrics.convergence import STRICT_HOLD
from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.studies.plots import LOOKS
from apnc.studies.results import Result, is_number
from apnc.studies.statistics import median
from apnc.studies.study import Study
from apnc.studies.table import markdown
from apnc_plant.robot import GRAVITY, RobotDescription, load_robot
from apnc_plant.robot.size import mean_leg_length
from research.command import main
from research.registry import STUDIES

DIRECTIONS: Final = tuple(range(0, 360, 45))
"""Directions of the push [deg]: 0 ahead, 90 to the left, where the robot looked at the start."""

FROUDE: Final = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.6, 2.0)
"""Change of the robot's speed over sqrt(g l), with l the length of a leg [1]."""

WALKED_S: Final = 15.0
"""How long it walks before the push [s]; a gait is stored by then."""

WITHIN_S: Final = 1.0
"""The push comes within this time by chance, so that it meets the legs anywhere in a stride [s]."""

AFTER_S: Final = 15.0
"""How long it has to return [s]."""

MIS: Final = (0.08, 0.15)

ENOUGH: Final = 0.9
"""Share of the runs that must return [1]."""

Row = dict[str, Any]


def impulse(robot: RobotDescription, froude: float) -> float:
    """Impulse that changes the speed of a robot by a share of sqrt(g l) [N s]."""
    return froude * robot.mass * math.sqrt(GRAVITY * mean_leg_length(robot))


def experiment(
    controller: str, seed: int, mi: float, direction: int, froude: float, robot: str = "lilibot"
) -> Experiment:
    """A walk with one push."""
    size = impulse(load_robot(robot), froude)
    angle = math.radians(direction)
    at = WALKED_S + WITHIN_S * float(np.random.default_rng(seed).uniform())
    push = Push(at, size * math.cos(angle), size * math.sin(angle))
    return Experiment(
        robot=robot, controller=controller, seed=seed, mi=mi, pushes=(push,),
        duration=WALKED_S + WITHIN_S + AFTER_S,
    )  # fmt: skip


def measure(record: Record) -> Result:
    """What became of the gait.

    ``in_gait`` says whether every phase was within 0.6 rad of the gait for a second before the
    push; ``returned_s`` is the time from the push until it was so again for good [s], 0 if it
    was never lost, None if it did not return; ``impulse`` is the push [N s].
    """
    (push,) = record.experiment.pushes
    target = metrics.default_target(len(record.legs))
    found: Result = {"impulse": math.hypot(push.x, push.y), "in_gait": False, "returned_s": None}
    if target is None or len(record.time) == 0:
        return found
    o1, o2, time = record.signals["o1"], record.signals["o2"], record.time
    near = metrics.phase_error(o1, o2, target) <= metrics.STRICT_TOLERANCE
    pushed = int(np.searchsorted(time, push.at))
    # phases are smoothed over samples to both sides, so those from the push on are left out
    error = metrics.phase_error(o1[:pushed], o2[:pushed], target)[time[:pushed] >= push.at - 1.0]
    found["in_gait"] = bool(len(error) and (error <= metrics.STRICT_TOLERANCE).all())
    after = np.flatnonzero((time >= push.at) & ~near)
    back = max(float(time[after[-1]]) - push.at, 0.0) if len(after) else 0.0
    held = time[-1] - push.at - back >= STRICT_HOLD
    if record.end == "complete" and held:
        found["returned_s"] = back
    return found


CELL: Final = ("mi", "controller", "direction", "froude")


def counts(results: Sequence[Result]) -> list[Row]:
    """A row per cell: pushes on robots in the gait, how many returned, how many fell, and times."""
    cells: dict[tuple[Any, ...], list[Result]] = {}
    for result in results:
        if "impulse" in result:  # it did not end with an error
            cells.setdefault(tuple(result[name] for name in CELL), []).append(result)
    rows = []
    for cell, walks in cells.items():
        own = [result for result in walks if result.get("in_gait")]
        times = [float(r["returned_s"]) for r in own if is_number(r.get("returned_s"))]
        rows.append(
            dict(zip(CELL, cell, strict=True))
            | {"impulse": round(float(walks[0]["impulse"]), 4), "walks": len(walks)}
            | {"pushed": len(own), "returned": len(times)}
            | {"fell": sum(bool(result.get("fell")) for result in own)}
            | {"median_s": round(median(times).value, 2) if times else ""}
        )
    return rows


def forgotten(
    rows: Sequence[Row], mi: float, controller: str, direction: int
) -> tuple[Row | None, Row | None]:
    """The largest push that is forgotten, as are all smaller ones, and the first that is not."""
    own = [
        row
        for row in rows
        if (float(row["mi"]), row["controller"], int(row["direction"]))
        == (mi, controller, direction)
    ]
    last = None
    for row in sorted(own, key=lambda row: float(row["froude"])):
        if not int(row["pushed"]) or int(row["returned"]) < ENOUGH * int(row["pushed"]):
            return last, row
        last = row
    return last, None


def _places(rows: Sequence[Row]) -> list[tuple[float, str]]:
    return list(dict.fromkeys((float(row["mi"]), row["controller"]) for row in rows))


def counts_table(rows: Sequence[Row]) -> str:
    """A line per direction; the largest push that is forgotten, with the time of the return."""
    directions = sorted({int(row["direction"]) for row in rows})
    return markdown(
        {"direction [deg]": str(direction)}
        | {
            f"MI {mi:.2f}, {named_controller(c).name} [N s]": _told(
                *forgotten(rows, mi, c, direction)
            )
            for mi, c in _places(rows)
        }
        for direction in directions
    )


def _told(last: Row | None, first: Row | None) -> str:
    if last is None and first is not None and not int(first["pushed"]):
        return "no gait before the push"
    failed = "" if first is None else "{impulse:.2f} ({returned}/{pushed})".format(**_plain(first))
    if last is None:
        return f"not {failed}"
    text = "{impulse:.2f} ({returned}/{pushed}, {median_s} s)".format(**_plain(last))
    return f"{text}, not {failed}" if failed else f"all, to {text}"


def _plain(row: Row) -> Row:
    return row | {"impulse": float(row["impulse"])}


def polar(rows: Sequence[Row]) -> list[Trace]:
    """Largest push that is forgotten [N s] over its direction, a line per MI and controller."""
    traces = []
    mis = sorted({mi for mi, _ in _places(rows)})
    for mi, controller in _places(rows):
        directions = sorted(
            {
                int(r["direction"])
                for r in rows
                if (float(r["mi"]), r["controller"]) == (mi, controller)
            }
        )
        last = [forgotten(rows, mi, controller, direction)[0] for direction in directions]
        size = [0.0 if row is None else float(row["impulse"]) for row in last]
        dash = ("solid", "dash", "dot", "dashdot")[mis.index(mi) % 4]
        traces.append({
            "type": "scatterpolar",
            "mode": "lines+markers",
            "name": f"MI {mi:.2f}, {named_controller(controller).name}",
            "theta": [*directions, directions[0]],
            "r": [*size, size[0]],
            "line": {"color": LOOKS[controller].colour, "dash": dash},
            "marker": {"color": LOOKS[controller].colour, "symbol": LOOKS[controller].symbol},
        })  # fmt: skip
    return traces


def figures_of(rows: Sequence[Row]) -> list[Figure]:
    """Largest push that is forgotten over its direction.

    Args:
        rows: of :func:`counts`.
    """
    axis = {"gridcolor": theme.GRID, "linecolor": theme.EDGE}
    plot = {
        "radialaxis": axis
        | {
            "ticksuffix": " N s",
            "dtick": 2.0,
            "angle": 67.5,
            "tickangle": 67.5,
            "rangemode": "tozero",
        },
        "domain": {"y": [0.0, 0.92]},
        "angularaxis": axis | {"rotation": 90, "direction": "counterclockwise", "ticksuffix": "°"},
        "bgcolor": theme.PAPER,
    }
    layout = theme.layout(480, polar=plot, hovermode="closest")
    note = f"Seen from above, ahead is up. {100 * ENOUGH:g} % of the runs return to the gait."
    data = polar(rows)
    return [Figure("pushes", "Pushes that are forgotten", note, data, layout, over_time=False)]


STUDY: Final = Study(
    STUDIES["basin.pushes"],
    experiment,
    {"mi": MIS, "direction": DIRECTIONS, "froude": FROUDE},
    controllers=("apnc", "apc"),
    measure=measure,
    figures=lambda results: figures_of(counts(results)),
    table=lambda results: counts_table(counts(results)),
)

if __name__ == "__main__":
    main(STUDY.name)
