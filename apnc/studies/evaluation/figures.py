"""Figures of the studies in the form of the paper's: boxes, success marks, significance."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

from apnc.report import theme
from apnc.studies.evaluation.grids import STUDIES
from apnc.studies.evaluation.statistics import compare, holm
from apnc.studies.evaluation.trial import Row, finite

LABELS: Final = {
    "apnc": "APNC",
    "apc": "APC alone",
    "tegotae": "Tegotae",
    "phase_reset": "phase resetting",
}
COLOURS: Final = {
    "apnc": theme.BLUE,
    "apc": theme.SKY,
    "tegotae": theme.ORANGE,
    "phase_reset": theme.GREEN,
}
MARKS: Final = {
    "apnc": "circle",
    "apc": "circle-open",
    "tegotae": "diamond",
    "phase_reset": "triangle-up",
}
CRITERIA: Final = {
    "convergence_time_s": "strict criterion: within 0.6 rad of the trot to the end",
    "convergence_time_authors_s": "the authors' criterion: first below 2.8 rad",
}
METRICS: Final = {
    "balance": "balance [1/rad]",
    "coordination": "coordination [1]",
    "cost_of_transport": "cost of transport [1]",
}


@dataclass(frozen=True)
class Figure:
    """One plot: heading, how to read it, plotly traces and layout."""

    title: str
    note: str
    data: list[dict[str, Any]]
    layout: dict[str, Any]


def methods_in(rows: Sequence[Row]) -> list[str]:
    """Methods that occur, in a fixed order."""
    present = {row["method"] for row in rows}
    return [method for method in LABELS if method in present]


def values(rows: Sequence[Row], column: str, **where: Any) -> list[float]:
    """Numbers of a column in the rows that match ``where``."""
    return [
        float(row[column])
        for row in rows
        if finite(row.get(column)) and all(row.get(k) == v for k, v in where.items())
    ]


def _boxes(rows: Sequence[Row], column: str, axis: str, **style: Any) -> list[dict[str, Any]]:
    traces = []
    for method in methods_in(rows):
        of_method = [r for r in rows if r["method"] == method and finite(r.get(column))]
        traces.append(
            {
                "type": "box",
                "name": LABELS[method],
                "x": [str(r[axis]) for r in of_method],
                "y": [r[column] for r in of_method],
                "marker": {"color": COLOURS[method], "size": 4},
                "line": {"width": 1.2},
                "boxpoints": "outliers",
                "offsetgroup": method,
                "legendgroup": method,
                **style,
            }
        )
    return traces


def _categories(rows: Sequence[Row], axis: str) -> list[str]:
    return [str(v) for v in sorted({row[axis] for row in rows})]


def convergence(rows: Sequence[Row], study: str, column: str) -> Figure:
    """Boxes of the convergence time and marks of the success rate over the study's axis."""
    axis = STUDIES[study].axis
    cells = _categories(rows, axis)
    traces = _boxes(rows, column, axis)
    for method in methods_in(rows):
        shares = []
        for cell in cells:
            inside = [r for r in rows if r["method"] == method and str(r[axis]) == cell]
            hits = sum(finite(r.get(column)) for r in inside)
            shares.append(100.0 * hits / len(inside) if inside else None)
        traces.append(
            {
                "type": "scatter",
                "mode": "markers",
                "name": f"{LABELS[method]}: success",
                "x": cells,
                "y": shares,
                "yaxis": "y2",
                "marker": {
                    "symbol": MARKS[method],
                    "color": COLOURS[method],
                    "size": 9,
                    "line": {"color": theme.INK, "width": 1},
                },
                "legendgroup": method,
                "offsetgroup": method,
            }
        )
    layout = theme.layout(
        380,
        boxmode="group",
        scattermode="group",
        xaxis=theme.axis(
            STUDIES[study].axis_title, type="category", categoryorder="array", categoryarray=cells
        ),
        yaxis=theme.axis("convergence time [s]", rangemode="tozero", domain=[0.0, 0.68]),
        yaxis2=theme.axis("success [%]", range=[-14, 114], domain=[0.74, 1.0]),
        hovermode="closest",
    )
    note = f"By {CRITERIA[column]}. Boxes: trials that converged; marks above: their share."
    return Figure(f"{STUDIES[study].title}: convergence", note, traces, layout)


def over_axis(rows: Sequence[Row], study: str, column: str, label: str) -> Figure:
    """Boxes of any column over the study's axis."""
    axis = STUDIES[study].axis
    layout = theme.layout(
        320,
        boxmode="group",
        xaxis=theme.axis(
            STUDIES[study].axis_title,
            type="category",
            categoryorder="array",
            categoryarray=_categories(rows, axis),
        ),
        yaxis=theme.axis(label),
        hovermode="closest",
    )
    title = f"{STUDIES[study].title}: {label.split(' [', maxsplit=1)[0]}"
    return Figure(title, "One box per method.", _boxes(rows, column, axis), layout)


def conditions(rows: Sequence[Row], column: str) -> Figure:
    """Boxes per condition; a star where APNC differs from a baseline at p <= 0.05 (Holm)."""
    figure = over_axis(rows, "conditions", column, METRICS[column])
    notes = []
    for condition, method, test in significance(rows, column):
        if test.p <= 0.05:
            notes.append(f"{condition} {LABELS[method]} (p = {test.p:.2g}, r = {test.effect:.2f})")
    text = "APNC differs from: " + "; ".join(notes) if notes else "APNC differs from no baseline"
    return Figure(figure.title, f"{text}. Mann-Whitney U, Holm.", figure.data, figure.layout)


def significance(rows: Sequence[Row], column: str) -> list[tuple[str, str, Any]]:
    """APNC against every baseline in every condition, corrected over all tests of all metrics."""
    tests = []
    for metric in METRICS:
        for condition in _categories(rows, "condition"):
            for method in methods_in(rows):
                if method != "apnc":
                    a = values(rows, metric, method="apnc", condition=condition)
                    b = values(rows, metric, method=method, condition=condition)
                    tests.append((metric, condition, method, compare(a, b)))
    corrected = holm([test for *_, test in tests])
    return [
        (condition, method, test)
        for (metric, condition, method, _), test in zip(tests, corrected, strict=True)
        if metric == column
    ]


def _bars(title: str, note: str, unit: str, bars: dict[str, list[float]]) -> Figure:
    traces = [
        {
            "type": "box",
            "name": name,
            "y": numbers,
            "boxpoints": "all",
            "jitter": 0.4,
            "pointpos": 0,
            "marker": {"color": colour, "size": 5},
            "line": {"width": 1.2},
            "showlegend": False,
        }
        for (name, numbers), colour in zip(bars.items(), _cycle(len(bars)), strict=True)
    ]
    layout = theme.layout(320, xaxis=theme.axis(""), yaxis=theme.axis(unit), hovermode="closest")
    return Figure(title, note, traces, layout)


def _cycle(n: int) -> list[str]:
    colours = [theme.BLUE, theme.ORANGE, theme.GREEN, theme.PURPLE, theme.VERMILLION, theme.SKY]
    return [colours[i % len(colours)] for i in range(n)]


def damage(rows: Sequence[Row]) -> Figure:
    """Speed with leg RF held still, per method."""
    bars = {LABELS[m]: values(rows, "path_speed_m_per_s", method=m) for m in methods_in(rows)}
    return _bars("Damaged leg: speed", "Commands of leg RF held at 0.", "speed [m/s]", bars)


def memory(rows: Sequence[Row]) -> Figure:
    """Speed at the end of each state, with and without the neural couplings."""
    bars = {
        f"{state.upper()} {'with' if method == 'apnc' else 'without'} ANC": values(
            rows, f"state_speed_{state}", method=method
        )
        for state in ("s1", "s2", "s3")
        for method in ("apnc", "apc")
    }
    note = "S1: formed; S2: front sensors stuck at 0.9; S3: after a reset, without feedback."
    return _bars("Motor memory: speed in each state", note, "speed [m/s]", bars)


def steering(rows: Sequence[Row]) -> list[Figure]:
    """Speed over the steps of MI, and yaw rate over the steps of the turn command."""
    speeds = [r for r in rows if r["course"] == "speeds"]
    turns = [r for r in rows if r["course"] == "turns"]
    figures = []
    if speeds:
        bars = {
            f"MI {mi}, leg {i}": values(speeds, f"speed_leg_{i}")
            for i, mi in enumerate((0.15, 0.4, 0.15), start=1)
        }
        figures.append(_bars("Steering: speed", "MI stepped up and down.", "speed [m/s]", bars))
    if turns:
        names = ("straight", "right", "left", "straight again")
        bars = {name: values(turns, f"yaw_rate_leg_{i}") for i, name in enumerate(names, start=1)}
        note = "Positive turns left."
        figures.append(_bars("Steering: yaw rate", note, "yaw rate [rad/s]", bars))
    return figures


Maker = Callable[[Sequence[Row]], list[Figure]]


def _converging(study: str) -> Maker:
    return lambda rows: [convergence(rows, study, column) for column in CRITERIA]


_MAKERS: Final[dict[str, Maker]] = {
    "mi": lambda rows: [
        *_converging("mi")(rows),
        over_axis(rows, "mi", "duty_factor_mean", "duty factor [1]"),
        over_axis(rows, "mi", "path_speed_m_per_s", "speed [m/s]"),
    ],
    "rate": _converging("rate"),
    "terrain": _converging("terrain"),
    "conditions": lambda rows: [conditions(rows, column) for column in METRICS],
    "damage": lambda rows: [damage(rows)],
    "memory": lambda rows: [memory(rows)],
    "steering": steering,
}


def figures_of(study: str, rows: Sequence[Row]) -> list[Figure]:
    """All figures of one study from its rows; none if there are no rows."""
    return _MAKERS[study](rows) if rows else []
