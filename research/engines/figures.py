"""Figures of the comparison: results over MI, the replay over time, and one walk per engine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from apnc.loop.engines import COMPILED, OWN_ENGINE
from apnc.loop.record import Record
from apnc.report import theme
from apnc.report.encoding import Signal
from apnc.report.figure import Figure, Trace
from apnc.report.lines import line
from apnc.studies.plots import spread
from apnc.studies.results import STRICT, Result, cells_in, is_number, matching
from research.contact.measure import TICK
from research.engines.replay import distances

STYLES: Final = {
    OWN_ENGINE: ("Exudyn", theme.BLUE, "circle"),
    "mujoco": ("MuJoCo", theme.ORANGE, "diamond"),
    COMPILED: ("plain C", theme.GREEN, "square"),
}
"""Label, colour and symbol by name of the engine."""

COLUMNS: Final = {
    STRICT: "convergence time, strict [s]",
    "late_speed_m_per_s": "speed of the last 10 s [m/s]",
    "stride_frequency_hz": "stride frequency [Hz]",
    "duty_factor_mean": "duty factor [1]",
    "largest_late_error_rad": "largest phase error of the last 10 s [rad]",
}
"""Titles of the figures over MI, by column."""

SHOWN: Final = 15.0
"""Length of a walk that is drawn over time [s]."""

LEAST: Final = 1e-17
"""Distance that is drawn in place of zero [m]."""

HALF_TURNS: Final = {"tickvals": [0.0, np.pi], "ticktext": ["0", "π"]}


def over_mi(results: Sequence[Result]) -> list[Figure]:
    """A figure per column."""
    return [_figure(results, column, title) for column, title in COLUMNS.items()]


def _figure(results: Sequence[Result], column: str, title: str) -> Figure:
    data: list[Trace] = []
    for engine in (name for name in STYLES if matching(results, engine=name)):
        points = [
            (f"{result['mi']:g}", float(result[column]))
            for result in matching(results, engine=engine)
            if is_number(result.get(column))
        ]
        data += spread(points, *STYLES[engine])
    cells = [f"{mi:g}" for mi in cells_in(results, "mi")]
    x = theme.axis("MI [1]", type="category", categoryorder="array", categoryarray=cells)
    layout = theme.layout(
        320, xaxis=x, yaxis=theme.axis(title), scattermode="group",
        hovermode="closest",
    )  # fmt: skip
    heading = title.split(" [", maxsplit=1)[0].capitalize()
    return Figure(f"engines-{column}", heading, "", data, layout, over_time=False)


def replay(engines: Sequence[str]) -> Figure:
    """Distance of other engines from Exudyn over time, under the same commands."""
    data: list[Trace] = []
    for engine in engines:
        name, colour, _ = STYLES[engine]
        found = np.maximum(distances(engine), LEAST)
        x = {"x": Signal(TICK * np.arange(1, len(found) + 1))}
        data.append(line(found, name, colour) | x)
    layout = theme.layout(
        340,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("distance [m]", type="log", exponentformat="power"),
    )
    note = "Lilibot's trot on fixed phases, the same commands in all engines."
    title = f"Distance from {STYLES[OWN_ENGINE][0]}"
    return Figure("engines-replay", title, note, data, layout)


def walks(records: Mapping[str, Record]) -> Figure:
    """Relative phases over time of one walk in each engine.

    Args:
        records: records by name of the engine.
    """
    data: list[Trace] = []
    for engine, record in records.items():
        name, colour, _ = STYLES[engine]
        shown = record.time < SHOWN
        phases = (record.signals["phi"][shown] + 1.0) % (2.0 * np.pi) - 1.0
        phases[1:][np.abs(np.diff(phases, axis=0)) > np.pi] = np.nan  # once round: a gap
        for k in range(phases.shape[1]):
            group = {"legendgroup": engine, "showlegend": k == 0, "x": Signal(record.time[shown])}
            data.append(line(phases[:, k], name, colour, width=1.2) | group)
    some = next(iter(records.values())).experiment
    names = ", ".join(f"φ1{leg}" for leg in range(2, record.n_legs + 1))
    axis = theme.axis(f"{names} [rad]", **HALF_TURNS)
    layout = theme.layout(320, xaxis=theme.axis("time [s]"), yaxis=axis)
    title, note = "The gait forms", f"MI {some.mi:g}, seed {some.seed}."
    return Figure("engines-walks", title, note, data, layout, over_time=False)
