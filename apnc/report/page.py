"""The report of a walk."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from apnc.features import WalkFeatures
from apnc.loop.provenance import what_was_run
from apnc.loop.record import End, Record
from apnc.report.animation import animation_data
from apnc.report.encoding import Signal
from apnc.report.figures import all_figures
from apnc.report.html import page
from apnc.report.lines import Run
from apnc.report.samples import LATE_S
from apnc.report.theme import leg_colours
from apnc.report.wording import facts, heading, rows, verdicts
from apnc_plant.signals import PLANT_SIGNALS

BEYOND: Final = 1e4
"""Smallest length, angle, speed, force or torque that only a diverged motion has [SI units]."""


def render(record: Record, summary: WalkFeatures) -> str:
    """HTML text of the report of a run, however the run ended.

    Pitfall: it contains plotly.js (packed, 0.5 MB) and the part of the record that it shows, most
    of it in 16 bits. The whole record is in ``record.csv``.
    """
    shown = drawable(record)
    run = Run(shown, summary) if len(shown) else None
    return page(
        "report.html.j2",
        all_figures(run) if run else [],
        scripts=("scene.js", "stage.js", "animation.js") if run else (),
        data=_data(run) if run else {},
        heading=heading(record.experiment),
        facts=facts(record),
        verdicts=verdicts(summary, record.experiment.duration),
        rows=rows(summary),
        colours=leg_colours(record.legs),
        known=what_was_run(record.experiment, record.parameters),
        notes=_notes(record, run),
    )


def drawable(record: Record) -> Record:
    """The run without the end of a diverged motion, whose numbers are too large to be drawn."""
    if record.end is not End.diverged:
        return record
    # not the work, which grows without bounds in a sound motion too
    names = [signal.name for signal in PLANT_SIGNALS if signal.name != "joint_work"]
    values = [record.signals[name].reshape(len(record), -1) for name in names]
    largest = np.abs(np.concatenate(values, axis=1)).max(axis=1)
    unsound = np.flatnonzero(~(largest < BEYOND))  # NaN too
    return record.until(int(unsound[0])) if len(unsound) else record


def _data(run: Run) -> dict[str, Any]:
    time, opens = run.record.time, run.samples.opens_at
    return {
        "time": Signal(time[run.samples.at], exact=True),
        "opensAt": None if opens is None else float(time[opens]),
        "animation": animation_data(run),
    }


def _notes(record: Record, run: Run | None) -> list[str]:
    notes, drawn = [], len(run.record) if run else 0
    if not len(record):
        notes.append("The run ended before its first sample; there is nothing to plot.")
    elif drawn < len(record):
        notes.append(
            f"From {record.time[drawn]:.2f} s on the motion is not drawn, since its numbers exceed "
            f"{BEYOND:g}. record.csv has it."
        )
    if run and (block := run.samples.block):
        notes.append(
            f"This run is long. Before the last {LATE_S:g} s, lines show the least and the largest "
            f"of every {block} samples, and the animation shows every {block // 2}th sample. "
            "record.csv has all samples."
        )
    return notes
