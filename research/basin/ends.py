"""Where the walks ended: counts, table and picture."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from apnc.controllers import named_controller
from apnc.report import theme
from apnc.report.figure import Trace
from apnc.studies.statistics import rate
from apnc.studies.table import markdown

Row = dict[str, Any]

CELL: Final = ("mi", "start", "controller")

NO_GAIT: Final = ("other", "fell")
"""Ends that are no gait."""


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
    return f"{100 * found.low:.0f} ... {100 * found.high:.0f} %"


def _time(row: Row) -> str:
    if row["median_s"] in ("", None):
        return "-"
    return "{:.1f} ({:.1f} ... {:.1f})".format(
        *(float(row[name]) for name in ("median_s", "low_s", "high_s"))
    )


COLOURS: Final = (theme.BLUE, theme.ORANGE, theme.GREEN, theme.PURPLE, theme.VERMILLION, theme.SKY)


def stacked(rows: Sequence[Row]) -> list[Trace]:
    """Bars of the shares of the ends [%], one per MI, start and controller."""
    total: Counter[str] = Counter()
    for row in rows:
        total[row["end"]] += int(row["walks"])
    ends = [end for end, _ in total.most_common() if end not in NO_GAIT]
    looks = dict(zip(ends, COLOURS, strict=False)) | {"other": theme.GREY, "fell": theme.INK}
    traces = []
    for end, colour in looks.items():
        own = [row for row in rows if row["end"] == end]
        if not own:
            continue
        traces.append({
            "type": "bar",
            "orientation": "h",
            "name": end,
            "y": [label(row) for row in own],
            "x": [100.0 * int(row["walks"]) / int(row["of"]) for row in own],
            "marker": {"color": colour},
        })  # fmt: skip
    return traces


def label(row: Row) -> str:
    """Name of a bar."""
    name = named_controller(row["controller"]).name
    return f"MI {float(row['mi']):.2f}, {name}, from {row['start']}"
