"""Where the walks ended: counts, table and picture."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from apnc.controllers import named_controller
from apnc.report.figure import Trace
from apnc.studies.plots import LOOKS
from apnc.studies.statistics import rate
from apnc.studies.table import markdown

Row = dict[str, Any]

CELL: Final = ("mi", "start", "controller")

BESIDE: Final = 0.32
"""Between the lines of two controllers, over that between two starts [1]."""


def counts(results: Sequence[Mapping[str, Any]]) -> list[Row]:
    """A row per MI, start, controller and end: how many walks, and how long they took.

    Times are from the touch moment until the walk was in the gait for good [s].
    """
    cells: dict[tuple[Any, ...], list[Mapping[str, Any]]] = {}
    for result in results:
        cells.setdefault(tuple(result[name] for name in CELL), []).append(result)
    rows = []
    for cell, own in cells.items():
        for end, walks in Counter(result["gait"] for result in own).most_common():
            times = [
                float(result["after_s"])
                for result in own
                if result["gait"] == end and result["after_s"] not in (None, "")
            ]
            spread = np.percentile(times, (10, 50, 90)) if times else [None] * 3
            took = {
                name: "" if value is None else round(float(value), 2)
                for name, value in zip(("low_s", "median_s", "high_s"), spread, strict=True)
            }
            row = dict(zip(CELL, cell, strict=True)) | {"end": end, "walks": walks}
            rows.append(row | {"of": len(own), **took})
    return rows


def counts_table(rows: Sequence[Row]) -> str:
    """A line per MI, start and controller: the ends with their counts, and the commonest's time."""
    lines: dict[tuple[str, ...], list[Row]] = {}
    for row in rows:
        lines.setdefault(tuple(str(row[name]) for name in CELL), []).append(row)
    return markdown(
        {
            "MI": f"{float(own[0]['mi']):.2f}",
            "starts from": f"{own[0]['start']} ({own[0]['of']})",
            "controller": named_controller(own[0]["controller"]).name,
            "ends in": ", ".join(f"{row['end']} {row['walks']}" for row in own),
            "share of the first": _share(own[0]),
            "reached after [s]": _time(own[0]),
        }
        for own in lines.values()
    )


def _share(row: Row) -> str:
    walks, of = int(row["walks"]), int(row["of"])
    found = rate([True] * walks + [False] * (of - walks))
    return f"{100 * found.low:.3g} ... {100 * found.high:.3g} %"


def _time(row: Row) -> str:
    if row["median_s"] in ("", None):
        return "-"
    return "{:.1f} ({:.1f} ... {:.1f})".format(
        *(float(row[name]) for name in ("median_s", "low_s", "high_s"))
    )


def commonest(rows: Sequence[Row]) -> list[Row]:
    """Of each MI, start and controller the row of the end that most walks have."""
    first: dict[tuple[Any, ...], Row] = {}
    for row in rows:
        first.setdefault(tuple(row[name] for name in CELL), row)
    return list(first.values())


def places(rows: Sequence[Row]) -> dict[str, float]:
    """Where the lines of a start lie, from above, by what it is called: start, end and share."""
    lines: dict[str, list[Row]] = {}
    for row in commonest(rows):
        lines.setdefault(str(row["start"]), []).append(row)
    called = {}
    for at, (start, own) in enumerate(lines.items()):
        shares = {f"{row['end']} {row['walks']}/{row['of']}" for row in own}
        called[f"from {start}: {' or '.join(sorted(shares))}"] = -float(at)
    return called


def times(rows: Sequence[Row]) -> list[Trace]:
    """Times to the commonest end over the start, a line per controller.

    A marker is the median, and eight of ten walks lie within its bar [s].

    Args:
        rows: of :func:`counts`, of one MI.
    """
    found = commonest(rows)
    starts = list(dict.fromkeys(row["start"] for row in found))
    controllers = list(dict.fromkeys(row["controller"] for row in found))
    traces = []
    for beside, controller in enumerate(controllers):
        own = [row for row in found if row["controller"] == controller]
        own = [row for row in own if row["median_s"] not in ("", None)]
        look = LOOKS[controller]
        middle, low, high = (
            [float(row[name]) for row in own] for name in ("median_s", "low_s", "high_s")
        )
        shift = BESIDE * (beside - (len(controllers) - 1) / 2)
        traces.append({
            "type": "scatter",
            "mode": "markers",
            "name": named_controller(controller).name,
            "x": middle,
            "y": [-starts.index(row["start"]) - shift for row in own],
            "error_x": {
                "type": "data",
                "symmetric": False,
                "array": [b - a for a, b in zip(middle, high, strict=True)],
                "arrayminus": [b - a for a, b in zip(low, middle, strict=True)],
                "color": look.colour,
            },
            "marker": {"color": look.colour, "symbol": look.symbol, "size": 9},
        })  # fmt: skip
    return traces
