"""Marks intervals of a run in a figure over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from apnc.report import theme
from apnc.report.encoding import Signal
from apnc.report.figure import Figure
from apnc_core.types import Array

Interval = tuple[float, float, str]
"""Start [s], end [s] and label."""


def marked(figure: Figure, time: Array, intervals: Sequence[Interval]) -> Figure:
    """A figure over time with a label above each interval and a band behind every other one.

    Args:
        figure: figure over time. The result holds its own times in each line.
        time: times [s] for the lines that have none.
        intervals: intervals in order. The time axis ends with the last.
    """
    layout = figure.layout
    margin = layout["margin"] | {"t": layout["margin"]["t"] + 30}
    layout = layout | {
        "height": layout["height"] + 30,
        "margin": margin,
        "xaxis": layout["xaxis"] | {"range": [0.0, intervals[-1][1]]},
        "shapes": [*layout.get("shapes", ()), *map(_band, intervals[::2])],
        "annotations": [*layout.get("annotations", ()), *map(_label, intervals)],
    }
    data = [{"x": Signal(time)} | trace for trace in figure.data]
    return replace(figure, data=data, layout=layout, over_time=False)


def _band(interval: Interval) -> dict[str, Any]:
    begin, end, _ = interval
    place = {"yref": "paper", "x0": begin, "x1": end, "y0": 0, "y1": 1, "layer": "below"}
    return {"type": "rect", "fillcolor": theme.BAND, "line": {"width": 0}} | place


def _label(interval: Interval) -> dict[str, Any]:
    begin, end, text = interval
    place = {"x": (begin + end) / 2, "y": 1.0, "yref": "paper", "yanchor": "bottom"}
    return {"text": text, "showarrow": False, "yshift": 24} | place  # over the legend
