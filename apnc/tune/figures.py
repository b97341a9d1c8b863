"""Figures of a tuned robot against MI, and of the progress of the search."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.report.lines import stacked
from apnc.tune.aims import AIM_ALONE, AIM_LIFT, AIM_SLIP
from apnc.tune.log import CHECK, Row
from apnc.tune.measured import MAX_SLIP, MIN_LIFT, MIN_SPEED
from apnc.tune.runs import MARGIN
from apnc.tune.validation import Cell, Validation, percent, with_article

KINDS: Final = (
    ("walk", "with ANC", theme.BLUE, "circle", "solid"),
    ("apc", "with APC alone", theme.ORANGE, "diamond-open", "dash"),
    ("varied", f"with ANC, body off by up to {percent(MARGIN)}", theme.GREEN, "square-open", "dot"),
)
"""Kinds of runs over the MI range: name, words, and how they are drawn."""

_SHOWN: Final = ("walk", "varied")
"""Kinds whose speed, lift and slip are drawn."""


def formed(found: Validation) -> Figure:
    """Share of good walks against MI."""
    traces = [
        _line(cells, [100.0 * cell.good / len(cell.runs) for cell in cells], look)
        for kind, *look in KINDS
        if (cells := found.of(kind))
    ]
    seeds = len(found.of("walk")[0].runs)
    note = (
        f"Share of {seeds} walks whose {found.gait} formed and held, and which got ahead on feet "
        f"that lift and hold. Dashed: {percent(AIM_ALONE)}, aimed at with APC alone and with the "
        "body off; with ANC all are aimed at."
    )
    layout = theme.layout(
        300,
        xaxis=_mi_axis(found),
        yaxis=theme.axis("good walks [%]", range=[-6, 106]),
        shapes=[_level(100.0 * AIM_ALONE, "y")],
    )
    title = f"Walks in {with_article(found.gait)} that holds"
    return Figure("formed", title, note, traces, layout, over_time=False)


def walked(found: Validation) -> Figure:
    """Speed, lift and slip against MI, with the aims."""
    rows: list[tuple[str, list[Trace]]] = []
    shapes: list[dict[str, Any]] = []
    measures: tuple[tuple[str, str, float, float | None, float], ...] = (
        ("speed", "speed [m/s]", found.speed, None, MIN_SPEED),
        ("lift", "lift [mm]", 1e3 * found.length, AIM_LIFT, MIN_LIFT),
        ("slip", "slip [% of stride]", 100.0, AIM_SLIP, MAX_SLIP),
    )
    for k, (name, title, scale, aim, least) in enumerate(measures):
        axis = f"y{k + 1}" if k else "y"
        traces: list[Trace] = []
        for kind, *look in KINDS:
            cells = found.of(kind)
            if kind in _SHOWN and cells:
                middle = [scale * cell.middle(name) for cell in cells]
                traces += [
                    _points(cells, name, scale, look),
                    _line(cells, middle, look, showlegend=k == 0),
                ]
        rows.append((title, traces))
        shapes.append(_level(scale * least, axis, "dot"))
        if aim is not None:
            shapes.append(_level(scale * aim, axis))
    note = (
        "Lines: medians; points: single walks that did not fall. Lift of the foot that lifts "
        "least, slip of the foot that slips most. Dashed: aims. Dotted: what a run needs to count "
        f"as a walk. The aims are a lift of {percent(AIM_LIFT)} of the leg and a slip of at most "
        f"{percent(AIM_SLIP)} of the stride; the speed is to grow with MI."
    )
    figure = stacked("walked", "Speed, lift and slip", note, rows, rangemode="tozero")
    last = figure.layout["xaxis"]["anchor"]
    figure.layout["xaxis"] = _mi_axis(found, anchor=last)
    figure.layout["shapes"] = shapes
    figure.layout["height"] = 430
    figure.layout["hovermode"] = "closest"
    return replace(figure, over_time=False)


def progress(rows: Sequence[Row]) -> Figure:
    """Cost of every candidate, of the best so far and of the checks, against candidates."""
    tried = {(row[0], row[1]): row[2] for row in rows if row[1] != CHECK}
    costs = list(tried.values())
    count = [sum(generation < g for generation, _ in tried) for g, n, *_ in rows if n == CHECK]
    checks = [row[2] for row in rows if row[1] == CHECK]
    best = [min(checks[: k + 1]) for k in range(len(checks))]
    number = list(range(1, len(costs) + 1))
    traces = [
        _scatter(number, costs, "a candidate, in its generation", theme.GREY, 3),
        _scatter(count, checks, "check of the favourite", theme.ORANGE, 8, "diamond"),
        {
            "type": "scatter", "mode": "lines", "name": "best check so far", "x": count, "y": best,
            "line": {"color": theme.BLUE, "width": 2.4, "shape": "hv"},
        },
    ]  # fmt: skip
    note = (
        "0 is a perfect walk. Every generation has seeds and bodies of its own, so that the costs "
        "of two generations differ by chance. A check walks the favourite at 11 MI, always with "
        "the same seeds; the best check is the robot of the file."
    )
    layout = theme.layout(
        300,
        xaxis=theme.axis("candidates"),
        yaxis=theme.axis("cost [1]", type="log"),
        hovermode="closest",
    )
    return Figure("progress", "Progress of the search", note, traces, layout, over_time=False)


def _mi_axis(found: Validation, **more: Any) -> dict[str, Any]:
    mi = [cell.mi for cell in found.of("walk")]
    ticks = {"tickvals": mi, "ticktext": [f"{each:.3g}" for each in mi]}
    return theme.axis("MI [1]", type="log", **ticks, **more)


def _line(cells: Sequence[Cell], y: Sequence[float], look: Sequence[str], **more: Any) -> Trace:
    name, colour, symbol, dash = look
    return {
        "type": "scatter", "mode": "lines+markers", "name": name, "legendgroup": name,
        "x": [cell.mi for cell in cells], "y": list(y),
        "line": {"color": colour, "width": 2, "dash": dash},
        "marker": {"symbol": symbol, "size": 9, "color": colour},
        "hovertemplate": "MI %{x:.3g}: %{y:.3g}",
    } | more  # fmt: skip


def _points(cells: Sequence[Cell], measure: str, scale: float, look: Sequence[str]) -> Trace:
    found = [
        (cell.mi, scale * getattr(run, measure))
        for cell in cells
        for run in cell.runs
        if run.fell == 1.0
    ]
    x, y = [mi for mi, _ in found], [value for _, value in found]
    trace = _scatter(x, y, look[0], look[1], 4)
    return trace | {"showlegend": False, "legendgroup": look[0], "opacity": 0.4}


def _scatter(
    x: Sequence[float], y: Sequence[float], name: str, colour: str, size: int,
    symbol: str = "circle",
) -> Trace:  # fmt: skip
    marker = {"color": colour, "size": size, "symbol": symbol}
    return {
        "type": "scatter", "mode": "markers", "name": name, "x": list(x), "y": list(y),
        "marker": marker, "hovertemplate": "%{x:.4g}: %{y:.4g}",
    }  # fmt: skip


def _level(y: float, axis: str, dash: str = "dash") -> dict[str, Any]:
    return {
        "type": "line", "xref": "paper", "x0": 0, "x1": 1, "yref": axis, "y0": y, "y1": y,
        "line": {"color": theme.GREY, "width": 1.2, "dash": dash},
    }  # fmt: skip
