"""Figures of the states S1 to S3: speeds, and a run with and without couplings (Fig. 10-12)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc.features import walk_features
from apnc.loop.engines import COMPILED
from apnc.loop.experiment import conditions_of
from apnc.loop.record import Record
from apnc.loop.schedule import steps_of
from apnc.loop.simulate import simulate
from apnc.report import theme
from apnc.report.figure import Figure, Trace
from apnc.report.figures import all_figures
from apnc.report.lines import Run, line, stacked
from apnc.studies.intervals import marked
from apnc.studies.plots import side_by_side
from apnc.studies.results import Result, values
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.study import Robot
from apnc_core import load
from apnc_plant.conditions import named_conditions
from apnc_plant.robot import RobotDescription

COUPLINGS: Final = {"apnc": "with ANC", "apc": "without ANC"}
STATES: Final = ("S1", "S2", "S3")
PANELS: Final = ("cpg", "phi", "gait", "gamma", "kappa")
"""Panels of a walk's report to show: outputs, relative phases, stances, gain, couplings."""


def _intervals(robot: RobotDescription) -> tuple[tuple[float, float, str], ...]:
    """Begin and end of each state [s], and what it is."""
    front = ", ".join(named_conditions("S2", robot).stuck)
    return (
        (TIMELINE.lowered, TIMELINE.broken, "S1"),
        (TIMELINE.broken, TIMELINE.stopped, f"S2: {front} stuck at 0.9"),
        (TIMELINE.stopped, TIMELINE.restarted, "MI = 0"),
        (TIMELINE.restarted, TIMELINE.end, "S3: no feedback"),
    )


def figures(results: Sequence[Result]) -> list[Figure]:
    """Speed at the end of each state, with and without the couplings."""
    groups = {
        f"{state} {words}": values(results, f"state_speed_{state.lower()}", controller=controller)
        for state in STATES
        for controller, words in COUPLINGS.items()
    }
    note = "S1: formed; S2: front sensors stuck at 0.9; S3: after a reset, without feedback."
    return [side_by_side("states-speed", "Speed in each state", note, "speed [m/s]", groups)]


def scenes(robot: Robot) -> list[Figure]:
    """Run seed 0 with and without the couplings, and draw both over time."""
    runs = {
        words: simulate(TIMELINE.experiment(controller, 0, robot=robot, engine=COMPILED))
        for controller, words in COUPLINGS.items()
    }
    return [figure for words, record in runs.items() for figure in over_time(record, words)]


def over_time(record: Record, words: str) -> list[Figure]:
    """Command, loads and the ``PANELS`` of a run, with the states marked."""
    run = Run(record, walk_features(record))
    panels = [_loads(run), *(panel for panel in all_figures(run) if panel.key in PANELS)]
    return [
        replace(
            marked(panel, record.time[run.samples.at], _intervals(record.robot)),
            key=f"states-{panel.key}-{record.experiment.controller}",
            title=f"{panel.title}, {words}",
        )
        for panel in panels
    ]


def _loads(run: Run) -> Figure:
    """MI, and for every foot the load that the circuits get beside the force of the ground."""
    record = run.record
    parameters: dict[str, Any] = dict(record.experiment.parameters())
    weight = parameters["robot_weight"]
    felt, _ = load.normalise(record.signals["grf"], weight, parameters["F_max"])
    ground = record.signals["foot_force"][..., 2] * (2.0 / weight)
    faulty = broken(record)
    look = {"showlegend": False}

    def lines(i: int, colour: str) -> list[Trace]:
        sound, stuck = (np.where(mask, felt[:, i], np.nan) for mask in (~faulty.T[i], faulty.T[i]))
        return [
            run.line(ground[:, i], "ground", theme.GREY, width=0.8, **look),
            run.line(sound, "F", colour, width=1.6, **look),
            run.line(stuck, "F, broken sensor", theme.VERMILLION, width=2.6, **look),
        ]

    panels = [("MI [1]", [run.line(record.signals["MI"], "MI", theme.INK, **look)])]
    panels += [
        (f"<b>{leg}</b> F [1]", lines(i, colour))
        for i, (leg, colour) in enumerate(run.colours.items())
    ]
    note = (
        "F: load of each foot as the circuits get it, in halves of the weight; thick where the "
        "sensor is stuck or silent. Grey: vertical force of the ground on the foot in the same "
        "unit; the panels cut off its peaks."
    )
    figure = stacked("loads", "Command and loads", note, panels)
    for i in range(record.n_legs):
        figure.layout[f"yaxis{i + 2}"] |= {"range": [-0.08, 1.25]}
    empty = {"x": [None], "hoverinfo": "skip"}
    figure.data.extend(
        line(np.empty(0), name, colour, width=width) | empty | {"y": [None]}
        for name, colour, width in (
            ("F", theme.INK, 1.6),
            ("F of a broken sensor", theme.VERMILLION, 2.6),
            ("force of the ground", theme.GREY, 0.8),
        )
    )
    return figure


def broken(record: Record) -> NDArray[np.bool_]:
    """Whether each sensor is stuck or silent at each tick, shape (T, n)."""
    found = np.zeros((len(record), record.n_legs), dtype=np.bool_)
    for start, entry in steps_of(record.experiment.conditions):
        conditions = conditions_of(entry, record.robot)
        legs = {*conditions.stuck, *conditions.silent(record.legs)}
        found[record.time >= start - 1e-9] = [leg in legs for leg in record.legs]
    return found
