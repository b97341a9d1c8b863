"""One number of a robot at a time, out to where the gait goes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, Final

from apnc.controllers import named_controller
from apnc.loop.experiment import Experiment
from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.studies.plots import LOOKS
from apnc.studies.results import Result, successes
from apnc.studies.study import Study
from apnc.studies.table import markdown
from apnc_plant.robot import RobotDescription
from research.command import main
from research.registry import STUDIES
from research.robustness import Row, nominal
from research.robustness.known import KNOWN, Known
from research.robustness.walks import SECONDS, WALKS

LEVELS: Final = 10
"""Steps outward from the robot's own value, to either side."""

WALKED: Final = ("MI 0.08", "MI 0.15", "MI 0.28")
"""Walks that a number is tried in. Judged are those in which the robot as it is forms the gait."""

CELL: Final = ("number", "controller", "level", "walk")
"""What tells the cells of the grid apart."""

ENOUGH: Final = 0.9
"""Share of the runs that must form the gait, in each walk [1]."""


def off(known: Known, level: int) -> float:
    """How far a number is off at a level: a factor, or a shift in its unit.

    A number that cannot be shifted below its value stays there at levels below 0.
    """
    if known.unit:
        return known.far * (max(0, level) if known.only_above else level) / LEVELS
    return float(known.times ** (level / LEVELS))


@cache  # a body walks many times
def body(robot: str, number: str, level: int) -> RobotDescription:
    """The robot with one number off."""
    known = KNOWN[number]
    return known.change(nominal(robot), off(known, level))


def experiment(
    controller: str, seed: int, number: str, level: int, walk: str, robot: str = "lilibot"
) -> Experiment:
    """A walk of the changed body under the controller of the robot as it is."""
    return Experiment(
        robot=body(robot, number, level),
        controller=controller,
        seed=seed,
        settings={"robot_weight": nominal(robot).weight},
        duration=SECONDS,
        **WALKS[walk],
    )


def _outward(known: Known) -> set[int]:
    """Levels of a number that change the robot."""
    lowest = 1 if known.only_above else -LEVELS
    return set(range(lowest, LEVELS + 1)) - {0}


def counts(results: Sequence[Result]) -> list[Row]:
    """How many runs formed the gait by the strict criterion, in each cell of the grid.

    A number that was not walked at all levels yet is left out, but for the robot as it is.
    """
    levels: dict[str, set[int]] = {}
    for result in results:
        levels.setdefault(result["number"], set()).add(int(result["level"]))
    cells: dict[tuple[Any, ...], list[Result]] = {}
    for result in results:
        number, level = result["number"], int(result["level"])
        if level == 0 or levels[number] >= _outward(KNOWN[number]):
            cells.setdefault(tuple(result[name] for name in CELL), []).append(result)
    return [
        dict(zip(CELL, cell, strict=True)) | {"runs": len(own), "strict": sum(successes(own))}
        for cell, own in cells.items()
    ]


def formed(rows: Sequence[Row], number: str, controller: str) -> dict[tuple[str, int], bool]:
    """Whether ``ENOUGH`` runs formed the gait, by walk and level.

    The robot at level 0 is the same for all numbers, so it has walked for one of them only.
    """
    return {
        (row["walk"], int(row["level"])): int(row["strict"]) >= ENOUGH * int(row["runs"])
        for row in rows
        if row["controller"] == controller and (row["number"] == number or int(row["level"]) == 0)
    }


def _walked_numbers(rows: Sequence[Row]) -> list[str]:
    """Numbers that were walked off their value."""
    return list(dict.fromkeys(row["number"] for row in rows if int(row["level"]) != 0))


def walks_judged(rows: Sequence[Row], controller: str) -> list[str]:
    """Walks in which the gait forms with the robot's own numbers."""
    own = {
        walk: good
        for number in dict.fromkeys(row["number"] for row in rows)
        for (walk, level), good in formed(rows, number, controller).items()
        if level == 0
    }
    return [walk for walk in WALKED if own.get(walk, False)]


def limits(rows: Sequence[Row], number: str, controller: str) -> tuple[int, int] | None:
    """Lowest and highest level up to which the gait forms without a gap in all walks judged.

    None if it forms in no walk with the robot's own numbers.
    """
    good = formed(rows, number, controller)
    walks = walks_judged(rows, controller)
    if not walks:
        return None
    low, high = 0, 0
    while all(good.get((walk, low - 1), False) for walk in walks):
        low -= 1
    while all(good.get((walk, high + 1), False) for walk in walks):
        high += 1
    return low, high


def _ends(known: Known, rows: Sequence[Row], number: str, label: str) -> str:
    """Both limits as text; "below" and "above" where the last level still forms the gait."""
    found = limits(rows, number, label)
    if found is None:
        return "-"
    texts = [f"{off(known, level):.3g}" for level in found]
    words = [f"{word} {text}" for word, text in zip(("below", "above"), texts, strict=True)]
    at_end = (found[0] == -LEVELS and not known.only_above, found[1] == LEVELS)
    ends = (word if end else text for word, text, end in zip(words, texts, at_end, strict=True))
    return " ... ".join(ends)


def counts_table(rows: Sequence[Row]) -> str:
    """A line per number: how sure it is, and from where to where the gait forms."""
    lines = []
    titles = {
        label: f"{named_controller(label).name} forms it in ({walks})"
        for label in dict.fromkeys(row["controller"] for row in rows)
        if (walks := ", ".join(walks_judged(rows, label)) or "no walk")
    }
    for number in _walked_numbers(rows):
        known = KNOWN[number]
        line = {
            "number": number,
            "off by": f"shift [{known.unit}]" if known.unit else "factor",
            "real one lies in": f"{known.low:.3g} ... {known.high:.3g}",
            "because": known.reason,
        }
        line |= {title: _ends(known, rows, number, label) for label, title in titles.items()}
        lines.append(line)
    return markdown(lines)


def bars(rows: Sequence[Row], *, shifts: bool) -> list[Trace]:
    """A bar per number and controller from limit to limit, and lines: tried, and the real one.

    Args:
        rows: of :func:`counts`.
        shifts: draw the numbers that are shifted, else those that are multiplied.
    """
    numbers = [
        number for number in reversed(_walked_numbers(rows)) if bool(KNOWN[number].unit) is shifts
    ]
    names = [_label(number) for number in numbers]
    traces: list[Trace] = []
    for controller in reversed(dict.fromkeys(row["controller"] for row in rows)):  # from below
        spans = [limits(rows, number, controller) for number in numbers]
        ends = [
            None if span is None else [off(KNOWN[number], level) for level in span]
            for number, span in zip(numbers, spans, strict=True)
        ]
        traces.append({
            "type": "bar",
            "orientation": "h",
            "name": named_controller(controller).name,
            "legendgroup": controller,
            "showlegend": not shifts,
            "y": names,
            "base": [None if end is None else end[0] for end in ends],
            "x": [None if end is None else end[1] - end[0] for end in ends],
            "marker": {"color": LOOKS[controller].colour},
        })  # fmt: skip
    for place, (number, name) in enumerate(zip(numbers, names, strict=True)):
        known = KNOWN[number]
        tried = [off(known, level) for level in (-LEVELS, LEVELS)]
        real = [max(known.low, tried[0]), min(known.high, tried[1])]
        for reach, said, colour, size in (
            (tried, "tried", theme.GREY, 5),
            (real, "where the real number lies", theme.INK, 9),
        ):
            traces.append({
                "type": "scatter",
                "mode": "lines+markers",
                "name": said,
                "legendgroup": said,
                "showlegend": place == 0 and not shifts,
                "x": reach,
                "y": [name, name],
                "line": {"color": colour, "width": size / 4.5},
                "marker": {
                    "symbol": "line-ns",
                    "size": size,
                    "line": {"width": size / 4.5, "color": colour},
                },
            })  # fmt: skip
    return traces


def _label(number: str) -> str:
    unit = KNOWN[number].unit
    return f"{number} [{unit}]" if unit else number


FACTORS: Final = theme.axis(
    "factor on the number [1]",
    type="log",
    range=[-0.95, 0.95],
    tickvals=[0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0],
)
SHIFTS: Final = theme.axis("shift, in the unit beside the number", range=[-54.0, 104.0])


def figures(results: Sequence[Result]) -> list[Figure]:
    """Limits of the factors, and of the shifts."""
    rows = counts(results)
    found = []
    for key, title, shifts, axis in (
        ("numbers-factors", "Numbers off by a factor", False, FACTORS),
        ("numbers-shifts", "Numbers off by a shift", True, SHIFTS),
    ):
        data = bars(rows, shifts=shifts)
        if not data or not data[0]["y"]:
            continue
        layout = theme.layout(
            90 + 26 * len(data[0]["y"]),
            xaxis=axis,
            yaxis=theme.axis("", automargin=True),
            barmode="group",
            hovermode="closest",
        )
        note = f"Up to where {100 * ENOUGH:g} % of the runs form the gait in each walk."
        found.append(Figure(key, title, note, data, layout, over_time=False))
    return found


STUDY: Final = Study(
    STUDIES["robustness.numbers"],
    experiment,
    {"number": tuple(KNOWN), "level": tuple(range(-LEVELS, LEVELS + 1)), "walk": WALKED},
    controllers=("apnc", "apc"),
    figures=figures,
    table=lambda results: counts_table(counts(results)),
)

if __name__ == "__main__":
    main(STUDY.name)
