"""Plots of results over an axis of the grid: points, quartiles, and shares of success."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from apnc.controllers import named_controller
from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.studies.results import (
    AUTHORS,
    STRICT,
    Result,
    cells_in,
    controllers_in,
    is_number,
    matching,
    successes,
    values,
)
from apnc.studies.statistics import of_runs


class Look(NamedTuple):
    """How a controller is drawn: a colour of the theme and a symbol of the plots."""

    colour: str
    symbol: str


LOOKS: Final[Mapping[str, Look]] = {
    "apnc": Look(theme.BLUE, "circle"),
    "apc": Look(theme.SKY, "circle-open"),
    "tegotae": Look(theme.ORANGE, "diamond-open"),
    "tegotae_best": Look(theme.VERMILLION, "diamond"),
    "phase_reset": Look(theme.GREEN, "triangle-up-open"),
    "phase_reset_best": Look(theme.PURPLE, "triangle-up"),
    "apnc_kept": Look(theme.GREY, "square"),
    "apnc_printed": Look(theme.BLACK, "square-open"),
}
"""By label of the controller."""

MIN_QUARTILES: Final = 5
"""Smallest number of values whose median and quartiles are drawn. Fewer are large points."""

NAMED: Final = 12
"""Most large points of a figure whose names are written beside them; more show them on hover."""

CRITERIA: Final = {
    STRICT: "strict criterion: within 0.6 rad of the gait, to the end",
    AUTHORS: "authors' criterion: first below 2.8 rad",
}
COLOURS: Final = (theme.BLUE, theme.ORANGE, theme.GREEN, theme.PURPLE, theme.VERMILLION, theme.SKY)


def counted(results: Sequence[Result], column: str, controller: str) -> str:
    """Name of a controller and the number of its runs that have a measure."""
    runs = matching(results, controller=controller)
    return (
        f"{named_controller(controller).name}, n = {of_runs(len(values(runs, column)), len(runs))}"
    )


def spread(
    points: Sequence[tuple[str, float]],
    name: str,
    colour: str,
    symbol: str = "circle",
    names: Sequence[str] = (),
) -> list[Trace]:
    """Traces of numbers by category: each as a point, and the quartiles where there are enough.

    Args:
        points: category and number.
        name: in the legend.
        colour: of the traces.
        symbol: of the points where there are fewer than ``MIN_QUARTILES``.
        names: of the points, shown beside them or on hover.
    """
    numbers: dict[str, list[float]] = {}
    for category, value in points:
        numbers.setdefault(category, []).append(value)
    many = {c: values for c, values in numbers.items() if len(values) >= MIN_QUARTILES}
    labels = names or [""] * len(points)
    group = {"type": "scatter", "mode": "markers", "name": name}
    group |= {"offsetgroup": name, "legendgroup": name}
    traces: list[Trace] = []
    for enough, look in ((True, {"size": 4, "opacity": 0.45}), (False, {"size": 8})):
        part = [
            (c, value, label)
            for (c, value), label in zip(points, labels, strict=True)
            if (c in many) is enough
        ]
        if part:
            x, y, text = (list(column) for column in zip(*part, strict=True))
            marker = {"color": colour, "symbol": "circle" if enough else symbol} | look
            place = {"x": x, "y": y, "marker": marker, "showlegend": not traces}
            told = {"text": text, "hovertemplate": "%{y:.4g}, %{text}"} if names else {}
            traces.append(group | place | told)
        if part and enough:
            traces.append(group | {"showlegend": False} | _quartiles(many, colour))
    return traces


def _quartiles(numbers: Mapping[str, Sequence[float]], colour: str) -> Trace:
    """A mark at the median of every category, on a bar from the first to the third quartile."""
    low, middle, high = np.array([np.percentile(v, [25, 50, 75]) for v in numbers.values()]).T
    bar = {"type": "data", "symmetric": False, "color": colour, "thickness": 7, "width": 0}
    reach = {"array": (high - middle).tolist(), "arrayminus": (middle - low).tolist()}
    line = {"color": theme.INK, "width": 2.5}
    mark = {"symbol": "line-ew", "size": 9, "color": theme.INK, "line": line}
    place = {"x": list(numbers), "y": middle.tolist(), "marker": mark, "error_y": bar | reach}
    return place | {"hovertemplate": "median %{y:.4g}"}


def _named(traces: Sequence[Trace]) -> None:
    """Write names beside the large points if these are few."""
    large = [trace for trace in traces if trace["marker"]["size"] == 8 and "text" in trace]
    if sum(len(trace["y"]) for trace in large) <= NAMED:
        for trace in large:
            beside = {"mode": "markers+text", "textposition": "middle right"}
            trace |= beside | {"textfont": {"size": 10}}


def over_axis(
    results: Sequence[Result], axis: tuple[str, str], column: str, label: str, note: str = ""
) -> Figure:
    """Figure of a column over an axis, one trace per controller.

    Args:
        results: of at least one trial.
        axis: name of the axis, and its title.
        column: the measure of the results.
        label: title of the vertical axis.
        note: text below the title.
    """
    traces = []
    for controller in controllers_in(results):
        known = [r for r in matching(results, controller=controller) if is_number(r.get(column))]
        points = [(str(result[axis[0]]), float(result[column])) for result in known]
        seeds = [f"seed {result['seed']}" for result in known]
        name, look = counted(results, column, controller), LOOKS[controller]
        traces += spread(points, name, look.colour, look.symbol, seeds)
    _named(traces)
    title = label.split(" [", maxsplit=1)[0].capitalize()
    cells = [str(cell) for cell in cells_in(results, axis[0])]
    return _figure(f"{results[0]['study']}-{column}", title, note, traces, cells, axis[1], label)


def _figure(
    key: str, title: str, note: str, data: list[Trace], cells: list[str], x: str, y: str
) -> Figure:
    layout = theme.layout(
        320,
        # the whole axis, with the cells that have no number
        xaxis=theme.axis(
            x,
            type="category",
            categoryorder="array",
            categoryarray=cells,
            range=[-0.5, len(cells) - 0.5],
        ),
        yaxis=theme.axis(y),
        scattermode="group",
        hovermode="closest",
    )
    layout["legend"] |= {"itemsizing": "constant"}
    return Figure(key, title, note, data, layout, over_time=False)


def convergence(results: Sequence[Result], axis: tuple[str, str]) -> list[Figure]:
    """A figure per criterion: times of the trials that converged, and above them their share."""
    return [_convergence(results, axis, column) for column in CRITERIA]


def _convergence(results: Sequence[Result], axis: tuple[str, str], column: str) -> Figure:
    note = f"By the {CRITERIA[column]}. Below: trials that converged; marks above: their share."
    figure = over_axis(results, axis, column, "convergence time [s]", note)
    figure = replace(figure, title=f"Convergence, {CRITERIA[column].split(':')[0]}")
    cells = cells_in(results, axis[0])
    for controller in controllers_in(results):
        label, name = counted(results, column, controller), named_controller(controller).name
        hits = [
            successes(results, column, controller=controller, **{axis[0]: cell}) for cell in cells
        ]
        share = [100.0 * sum(hit) / len(hit) if hit else None for hit in hits]
        look = {
            "symbol": LOOKS[controller].symbol,
            "color": LOOKS[controller].colour,
            "size": 9,
            "line": {"color": theme.INK},
        }
        trace = {"type": "scatter", "mode": "markers", "name": f"{name}: success", "marker": look}
        place = {"x": [str(cell) for cell in cells], "y": share, "yaxis": "y2"}
        figure.data.append(trace | place | {"legendgroup": label, "offsetgroup": label})
    figure.layout["height"] = 380
    figure.layout["yaxis"] |= {"rangemode": "tozero", "domain": [0.0, 0.68]}
    figure.layout["yaxis2"] = theme.axis("success [%]", range=[-14, 114], domain=[0.74, 1.0])
    return figure


def side_by_side(
    key: str,
    title: str,
    note: str,
    unit: str,
    groups: Mapping[str, Sequence[float]],
    colours: Sequence[str] = COLOURS,
) -> Figure:
    """Figure of groups of numbers beside each other.

    Args:
        key: of the figure.
        title: of the figure.
        note: text below the title.
        unit: title of the vertical axis.
        groups: numbers by name of the group.
        colours: of the groups, repeated if there are more groups.
    """
    traces = [
        trace | {"showlegend": False}
        for at, (name, numbers) in enumerate(groups.items())
        for trace in spread([(name, value) for value in numbers], name, colours[at % len(colours)])
    ]
    figure = _figure(key, title, note, traces, list(groups), "", unit)
    figure.layout["scattermode"] = "overlay"
    return figure
