"""Figures of the schedules: speed and yaw rate per interval, and a run over time (Fig. 13, 14)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

import numpy as np

from apnc import metrics
from apnc.features import walk_features
from apnc.loop.engines import COMPILED
from apnc.loop.record import Record
from apnc.loop.schedule import steps_of
from apnc.loop.simulate import simulate
from apnc.report import theme
from apnc.report.encoding import Signal
from apnc.report.figure import Figure, Trace
from apnc.report.lines import Run, line, stacked
from apnc.studies.intervals import Interval, marked
from apnc.studies.plots import COLOURS, side_by_side
from apnc.studies.results import Result, matching, values
from apnc.studies.steering.schedules import SPEED, SPEEDS, YAW_RATE, experiment
from apnc.studies.study import Robot
from apnc_core.types import Array
from apnc_plant.robot.leg_names import by_place

WAYS: Final = ("straight", "right", "left", "straight again")
"""Name of each interval of the schedule of turns."""


def figures(results: Sequence[Result]) -> list[Figure]:
    """Speed over the intervals of the schedule of speeds, and yaw rate over those of turns."""
    mis = [f"MI {mi:g}, interval {i}" for i, (_, mi) in enumerate(SPEEDS, start=1)]
    return [
        side_by_side(f"steering-{schedule}", title, note, unit, {
            name: values(results, f"{column}_{i}", schedule=schedule)
            for i, name in enumerate(names, start=1)
        })
        for schedule, title, note, unit, column, names in (
            ("speeds", "Speed", "MI stepped up and down.", "speed [m/s]", SPEED, mis),
            ("turns", "Yaw rate", "Positive turns left.", "yaw rate [rad/s]", YAW_RATE, WAYS),
        )
        if matching(results, schedule=schedule)
    ]  # fmt: skip


def scenes(robot: Robot) -> list[Figure]:
    """Run seed 0 along each schedule and draw it over time."""
    speeds, turns = (
        simulate(experiment(schedule, robot=robot, engine=COMPILED))
        for schedule in ("speeds", "turns")
    )
    return [speeds_over_time(speeds), turns_over_time(turns), path(turns)]


def speeds_over_time(record: Record) -> Figure:
    """MI, speed, path length and stride frequency over the schedule of speeds."""
    run, plant, time = Run(record, walk_features(record)), record.signals, record.time
    (velocity_x, velocity_y, _), yaw = plant["velocity"].T, plant["rpy"][:, 2]
    ahead = velocity_x * np.cos(yaw) + velocity_y * np.sin(yaw)
    slow = metrics.smoothed_speed(time, plant["position"], yaw)
    steps = np.diff(metrics.smooth(plant["position"][:, :2]), axis=0)
    way = np.append(0.0, np.cumsum(np.linalg.norm(steps, axis=1)))
    panels = [
        ("MI [1]", [_command(run, record.signals["MI"])]),
        ("speed [m/s]", [
            run.line(ahead, "at every moment", theme.SKY, width=0.7),
            run.line(slow, "smoothed over 1.5 s", theme.BLUE, width=2.2),
        ]),
        ("path [m]", [run.line(way, "path", theme.INK, showlegend=False)]),
        ("stride [Hz]", _frequencies(run)),
    ]  # fmt: skip
    note = (
        "Speed along the present heading; length of the smoothed path; stride frequency of each "
        "leg, from the cycles of its oscillator. Seed 0."
    )
    figure = stacked("steering-speeds-time", "Schedule of speeds", note, panels)
    figure.layout["yaxis4"] |= {"rangemode": "tozero"}
    words = [f"MI {mi:g}" for _, mi in steps_of(record.experiment.mi)]
    return marked(figure, time[run.samples.at], _intervals(record, record.experiment.mi, words))


def turns_over_time(record: Record) -> Figure:
    """Steering, hip commands of the front legs, yaw and yaw rate over the schedule of turns."""
    run, time = Run(record, walk_features(record)), record.time
    yaw = np.unwrap(record.signals["rpy"][:, 2])
    hips = np.degrees(record.signals["theta_hip"]).T
    places = by_place(record.legs)
    named = {places[f"{side} front"] for side in ("right", "left")}
    front = {leg: hip for leg, hip in zip(record.legs, hips, strict=True) if leg in named}
    panels = [
        ("turn [1]", [_command(run, record.signals["turn"])]),
        *(
            (f"hip {leg} [°]", [run.line(hip, leg, run.colours[leg], width=0.9)])
            for leg, hip in front.items()
        ),
        ("yaw [°]", [run.line(np.degrees(yaw), "yaw", theme.INK, showlegend=False)]),
        ("rate [rad/s]", [
            run.line(np.gradient(metrics.smooth(yaw), time), "rate", theme.BLUE, showlegend=False)
        ]),
    ]  # fmt: skip
    note = (
        "Positive turns left: larger commands to the right legs, smaller ones to the left. Rate: "
        "of the yaw, smoothed over 1.5 s. Seed 0."
    )
    figure = stacked("steering-turns-time", "Schedule of turns", note, panels)
    low, high = np.min(list(front.values())), np.max(list(front.values()))
    for panel in range(2, 2 + len(front)):
        figure.layout[f"yaxis{panel}"] |= {"range": [low - 1.0, high + 1.0]}
    return marked(figure, time[run.samples.at], _intervals(record, record.experiment.turn, WAYS))


def path(record: Record) -> Figure:
    """Path of the trunk from above along the schedule of turns, one colour per interval."""
    at = metrics.smooth(record.signals["position"][:, :2])
    traces: list[Trace] = []
    intervals = _intervals(record, record.experiment.turn, WAYS)
    for i, (begin, end, name) in enumerate(intervals):
        inside = slice(*np.searchsorted(record.time, [begin - 1e-9, end + 1e-9]))
        x, y = at[inside].T
        text = f"{name}, {begin:g} to {end:g} s"
        traces.append(line(y, text, COLOURS[i % len(COLOURS)], width=2.6) | {"x": Signal(x)})
    ends = (("start", "circle-open", at[:1].T), ("end", "circle", at[-1:].T))
    for name, symbol, (x, y) in ends:
        mark = {"size": 11, "color": theme.INK, "symbol": symbol, "line": {"width": 2}}
        place = {"x": x.tolist(), "y": y.tolist(), "marker": mark}
        traces.append({"type": "scatter", "mode": "markers", "name": name, **place})
    equal = theme.axis("y [m]", scaleanchor="x", scaleratio=1)
    layout = theme.layout(460, xaxis=theme.axis("x [m]"), yaxis=equal, hovermode="closest")
    note = "Seen from above, equal scales; smoothed over 1.5 s. The robot starts along x. Seed 0."
    return Figure("steering-path", "Path of the schedule of turns", note, traces, layout, False)


def _intervals(record: Record, command: object, names: Sequence[str]) -> list[Interval]:
    starts = [start for start, _ in steps_of(command)]
    return [
        (*span, name)
        for span, name in zip(pairwise([*starts, record.experiment.duration]), names, strict=True)
    ]


def _command(run: Run, values: Array) -> Trace:
    trace = run.line(values, "command", theme.INK, width=2.0, showlegend=False)
    trace["line"]["shape"] = "hv"
    return trace


def _frequencies(run: Run) -> list[Trace]:
    """Stride frequency of every leg, one point in the middle of each cycle of its oscillator."""
    record, c = run.record, run.record.signals
    traces = []
    for starts, (leg, colour) in zip(
        metrics.cycle_starts(c["o1"], c["o2"]), run.colours.items(), strict=True
    ):
        middles = (starts[:-1] + starts[1:]) / 2 / record.experiment.rate
        rate = record.experiment.rate / np.diff(starts)
        traces.append(line(rate, leg, colour, width=1.2) | {"x": Signal(middles)})
    return traces
