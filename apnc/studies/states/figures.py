"""Speeds in the states S1 to S3, and one run of each kind over time (Fig. 10-12)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

from apnc.loop.record import Record
from apnc.loop.simulate import simulate
from apnc.report import theme
from apnc.report.encoding import float32
from apnc.report.figure import Figure
from apnc.report.figures import all_figures
from apnc.report.panels import Run
from apnc.studies.plots import side_by_side
from apnc.studies.rows import Row, values
from apnc.studies.states.timeline import TIMELINE
from apnc.summary import summarise

COUPLINGS: Final = {"apnc": "with ANC", "apc": "without ANC"}
STATES: Final = ("S1", "S2", "S3")
PANELS: Final = ("cpg", "phi", "gait")
"""Of the report of a walk: outputs, relative phases and stances."""

_SPANS: Final = (
    (TIMELINE.lowered, TIMELINE.broken, "S1"),
    (TIMELINE.broken, TIMELINE.stopped, "S2: RF, LF stuck at 0.9"),
    (TIMELINE.stopped, TIMELINE.restarted, "MI = 0"),
    (TIMELINE.restarted, TIMELINE.end, "S3: no feedback"),
)


def figures(rows: Sequence[Row]) -> list[Figure]:
    """Speed at the end of each state, with and without the couplings."""
    groups = {
        f"{state} {words}": values(rows, f"state_speed_{state.lower()}", method=method)
        for state in STATES
        for method, words in COUPLINGS.items()
    }
    note = "S1: formed; S2: front sensors stuck at 0.9; S3: after a reset, without feedback."
    return [side_by_side("states-speed", "Speed in each state", note, "speed [m/s]", groups)]


def scenes() -> list[Figure]:
    """The run of seed 0 with and without the couplings, over time."""
    return [
        figure
        for method, words in COUPLINGS.items()
        for figure in over_time(simulate(TIMELINE.experiment(method, 0)), words)
    ]


def over_time(record: Record, words: str) -> list[Figure]:
    """Outputs, relative phases and stances of a run, with the states marked."""
    run = Run(record, summarise(record))
    time = {"x": float32(record.time[run.samples.at])}
    found = []
    for panel in (panel for panel in all_figures(run) if panel.key in PANELS):
        layout = panel.layout | {
            "height": panel.layout["height"] + 30,
            "margin": panel.layout["margin"] | {"t": panel.layout["margin"]["t"] + 30},
            "xaxis": panel.layout["xaxis"] | {"range": [0.0, TIMELINE.end]},
            "shapes": [*panel.layout.get("shapes", ()), *map(_band, _SPANS[::2])],
            "annotations": [*panel.layout.get("annotations", ()), *map(_label, _SPANS)],
        }
        found.append(
            replace(
                panel,
                key=f"states-{panel.key}-{record.experiment.method}",
                title=f"{panel.title}, {words}",
                data=[time | trace for trace in panel.data],
                layout=layout,
                over_time=False,
            )
        )
    return found


def _band(span: tuple[float, float, str]) -> dict[str, Any]:
    begin, end, _ = span
    place = {"yref": "paper", "x0": begin, "x1": end, "y0": 0, "y1": 1, "layer": "below"}
    return {"type": "rect", "fillcolor": theme.BAND, "line": {"width": 0}} | place


def _label(span: tuple[float, float, str]) -> dict[str, Any]:
    begin, end, text = span
    place = {"x": (begin + end) / 2, "y": 1.0, "yref": "paper", "yanchor": "bottom"}
    return {"text": text, "showarrow": False, "yshift": 24} | place  # over the legend
