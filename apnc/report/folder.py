"""The folder of a run: its summary, record and report."""

from __future__ import annotations

import json
from pathlib import Path

from apnc.features import WalkFeatures, walk_features
from apnc.loop.columns import column_names
from apnc.loop.csv_file import write_csv
from apnc.loop.provenance import what_was_run
from apnc.loop.record import Record
from apnc.report import RUN_FILES
from apnc.report.page import render
from build_fmu.writing import Write, write_together


def write_run(record: Record, folder: Path | str) -> WalkFeatures:
    """Write ``summary.json``, ``record.csv`` and ``report.html`` of a run, all or none.

    Args:
        record: the run, however it ended.
        folder: made if missing; files of an older run in it are replaced.

    Returns:
        What is measured of the run.

    Raises:
        OSError: a file cannot be written.
    """
    summary = walk_features(record)
    text = summary_text(record, summary)
    writers: tuple[Write, ...] = (
        lambda path: path.write_text(text, encoding="utf-8"),
        lambda path: write_csv(record, path),
        lambda path: path.write_text(render(record, summary), encoding="utf-8"),
    )
    write_together(Path(folder), dict(zip(RUN_FILES, writers, strict=True)))
    return summary


def summary_text(record: Record, summary: WalkFeatures) -> str:
    """Text of ``summary.json``: figures of the run, what was run, and units of the columns."""
    units = {"columns": {column.name: column.unit for column in column_names(record)}}
    content = summary.to_dict() | what_was_run(record.experiment, record.parameters) | units
    return json.dumps(content, indent=2, allow_nan=False) + "\n"
