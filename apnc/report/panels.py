"""A plot with one row per leg, all rows on the same scales."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc.report import theme
from apnc.report.encoding import float32

# Name, samples (T, n), line width, dash, opacity.
Series = tuple[str, NDArray[np.float64], float, str, float]

_ROW: Final = 78
_GAP: Final = 0.045


def leg_panels(
    legs: Sequence[str],
    series: Sequence[Series],
    title: str,
    y_range: tuple[float, float] | None = None,
) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """Traces and layout of stacked rows, one per leg, sharing the time axis and the y range.

    Args:
        legs: leg names, top row first.
        series: signals drawn in every row.
        title: title of the y axes with unit.
        y_range: range of every row to begin with; None fits the data.
    """
    colours = theme.leg_colours(legs)
    traces = [_trace(leg, i, one, colours[leg]) for i, leg in enumerate(legs) for one in series]
    # Entries without data: the legend explains the line styles once, not once per leg.
    traces += [_legend_entry(one) for one in series]
    layout = theme.layout(80 + _ROW * len(legs), annotations=_names(legs, colours, title))
    layout["xaxis"] = theme.axis("time [s]", anchor=f"y{len(legs)}" if len(legs) > 1 else "y")
    for i in range(len(legs)):
        layout[f"yaxis{i + 1 if i else ''}"] = _row_axis(i, len(legs), y_range)
    return traces, layout


def _span(i: int, n: int) -> tuple[float, float]:
    height = (1 - _GAP * (n - 1)) / n
    top = 1 - i * (height + _GAP)
    return max(0.0, top - height), top


def _row_axis(i: int, n: int, y_range: tuple[float, float] | None) -> dict[str, Any]:
    shared: dict[str, Any] = {} if i == 0 else {"matches": "y"}
    if y_range is not None:
        shared["range"] = list(y_range)
    domain = list(_span(i, n))
    return theme.axis("", domain=domain, nticks=3, showline=True, mirror=True, **shared)


def _trace(leg: str, i: int, series: Series, colour: str) -> dict[str, Any]:
    name, samples, width, dash, opacity = series
    return {
        "type": "scatter",
        "mode": "lines",
        "name": f"{leg} {name}",
        "y": float32(samples[:, i]),
        "yaxis": f"y{i + 1}" if i else "y",
        "line": {"color": colour, "width": width, "dash": dash},
        "opacity": opacity,
        "showlegend": False,
    }


def _legend_entry(series: Series) -> dict[str, Any]:
    name, _, width, dash, _ = series
    return {
        "type": "scatter",
        "mode": "lines",
        "name": name,
        "x": [None],
        "y": [None],
        "line": {"color": theme.INK, "width": width, "dash": dash},
        "hoverinfo": "skip",
    }


def _names(legs: Sequence[str], colours: dict[str, str], title: str) -> list[dict[str, Any]]:
    names = [
        _text(f"<b>{leg}</b>", 0.006, _span(i, len(legs))[1] - 0.012, colours[leg])
        for i, leg in enumerate(legs)
    ]
    side = {"textangle": -90, "xanchor": "center", "xshift": -56, "yanchor": "middle"}
    return [*names, _text(title, 0.0, 0.5, theme.INK) | side]


def _text(text: str, x: float, y: float, colour: str) -> dict[str, Any]:
    return {
        "text": text,
        "xref": "paper",
        "yref": "paper",
        "x": x,
        "y": y,
        "xanchor": "left",
        "yanchor": "top",
        "showarrow": False,
        "bgcolor": "rgba(255,255,255,0.75)",
        "font": {"color": colour, "size": 12},
    }
