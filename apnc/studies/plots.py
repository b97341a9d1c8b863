"""Plots of results over an axis of the grid: boxes or points, and shares of success."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

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

MIN_BOX: Final = 5
"""Smallest number of values for a box. Fewer are drawn as points."""

CRITERIA: Final = {
    STRICT: "strict criterion: within 0.6 rad of the gait, to the end",
    AUTHORS: "authors' criterion: first below 2.8 rad",
}
COLOURS: Final = (theme.BLUE, theme.ORANGE, theme.GREEN, theme.PURPLE, theme.VERMILLION, theme.SKY)


def counted(results: Sequence[Result], column: str, controller: str) -> str:
    """Name of a controller and the number of its runs that have a figure."""
    runs = matching(results, controller=controller)
    return (
        f"{named_controller(controller).name}, n = {of_runs(len(values(runs, column)), len(runs))}"
    )


def spread(
    points: Sequence[tuple[str, float]], name: str, colour: str, symbol: str = "circle"
) -> list[Trace]:
    """Traces of numbers by category: a box for ``MIN_BOX`` numbers and more, otherwise points."""
    count = {category: sum(c == category for c, _ in points) for category, _ in points}
    box = {"type": "box", "marker": {"color": colour, "size": 4}, "line": {"width": 1.2}}
    mark = {"color": colour, "size": 7, "symbol": symbol}
    single = {"type": "scatter", "mode": "markers", "marker": mark}
    traces: list[Trace] = []
    for look, boxed in ((box, True), (single, False)):
        part = [(c, value) for c, value in points if (count[c] >= MIN_BOX) is boxed]
        if part:
            place = {"x": [c for c, _ in part], "y": [value for _, value in part]}
            group = {"name": name, "offsetgroup": name, "legendgroup": name}
            traces.append(look | place | group | {"showlegend": not traces})
    return traces


def over_axis(
    results: Sequence[Result], axis: tuple[str, str], column: str, label: str, note: str = ""
) -> Figure:
    """Figure of a column over an axis, one trace per controller.

    Args:
        results: of at least one trial.
        axis: name of the axis, and its title.
        column: the figure of the results.
        label: title of the vertical axis.
        note: text below the title.
    """
    traces = []
    for controller in controllers_in(results):
        points = [
            (str(result[axis[0]]), float(result[column]))
            for result in matching(results, controller=controller)
            if is_number(result.get(column))
        ]
        look = LOOKS[controller]
        traces += spread(points, counted(results, column, controller), look.colour, look.symbol)
    title = label.split(" [", maxsplit=1)[0].capitalize()
    cells = [str(cell) for cell in cells_in(results, axis[0])]
    return _figure(f"{results[0]['study']}-{column}", title, note, traces, cells, axis[1], label)


def _figure(
    key: str, title: str, note: str, data: list[Trace], cells: list[str], x: str, y: str
) -> Figure:
    layout = theme.layout(
        320,
        xaxis=theme.axis(x, type="category", categoryorder="array", categoryarray=cells),
        yaxis=theme.axis(y),
        boxmode="group",
        scattermode="group",
        hovermode="closest",
    )
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
    figure.layout.update(boxmode="overlay", scattermode="overlay")
    return figure
