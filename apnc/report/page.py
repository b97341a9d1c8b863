"""The report of a walk."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np

from apnc.loop.provenance import what_was_run
from apnc.loop.record import End, Record
from apnc.report.animation import animation_data
from apnc.report.encoding import packed
from apnc.report.figures import all_figures
from apnc.report.html import page
from apnc.report.panels import Run
from apnc.report.samples import LATE_S, Samples
from apnc.report.theme import leg_colours
from apnc.report.wording import facts, heading, rows, verdicts
from apnc.summary import Summary

BEYOND: Final = 1e4
"""Size from which on a length, angle, speed, force or torque is that of a diverged motion [SI]."""


def render(record: Record, summary: Summary) -> str:
    """HTML text of the report of a run, however it ended.

    Args:
        record: the run.
        summary: its key figures.

    Pitfall: it carries plotly.js (about 5 MB) and what it shows of the record; it is no archive.
    """
    shown = drawable(record)
    run = Run(shown, summary, Samples(shown.time)) if len(shown) else None
    known = what_was_run(record.experiment)
    return page(
        "report.html.j2",
        all_figures(run) if run else [],
        scripts=("scene.js", "animation.js"),
        data=_data(run) if run else {},
        heading=heading(record.experiment),
        facts=facts(record),
        verdicts=verdicts(summary, record.experiment.duration),
        rows=rows(summary),
        colours=leg_colours(record.legs),
        known=known,
        notes=_notes(record, shown, run),
    )


def drawable(record: Record) -> Record:
    """The run without the end of a diverged motion, whose numbers have no scale to draw them on."""
    if record.end is not End.diverged:
        return record
    sound = np.ones(len(record), dtype=np.bool_)
    for name, values in record.plant.items():
        if name != "joint_work":  # grows without bounds in a sound motion, too
            flat = values.reshape(len(record), -1)
            sound &= (np.abs(flat) < BEYOND).all(axis=1)  # NaN is not
    count = len(record) if sound.all() else int(np.argmin(sound))

    def cut(channels: Mapping[str, Any]) -> dict[str, Any]:
        return {name: values[:count] for name, values in channels.items()}

    return replace(
        record,
        time=record.time[:count],
        plant=cut(record.plant),
        controller=cut(record.controller),
    )


def _data(run: Run) -> dict[str, Any]:
    at, opens = run.samples.at, run.samples.opens_at
    return {
        "time": packed(run.record.time[at], "<f4"),
        "opensAt": None if opens is None else float(run.record.time[opens]),
        "animation": animation_data(run),
    }


def _notes(record: Record, shown: Record, run: Run | None) -> list[str]:
    notes = []
    if not len(record):
        notes.append("The run ended before its first sample; there is nothing to plot.")
    elif len(shown) < len(record):
        begin = record.time[len(shown)]
        notes.append(
            f"From {begin:.2f} s on the motion has no scale (numbers beyond {BEYOND:g}); it is not "
            "drawn. record.csv has it."
        )
    if run and run.samples.block:
        notes.append(
            f"A long run: all lines but the last {LATE_S:g} s show the least and the largest of "
            f"every {run.samples.block} samples, the animation every {run.samples.block // 2}th. "
            "record.csv has them all."
        )
    return notes
