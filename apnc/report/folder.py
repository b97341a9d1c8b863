"""The folder of a run: summary, record and report, of one run and whole, or not at all."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from apnc.loop.csv_file import write_csv
from apnc.loop.provenance import what_was_run
from apnc.loop.record import Record
from apnc.report.page import render
from apnc.summary import summarise

Write = Callable[[Path], object]


def write_together(folder: Path, files: dict[str, Write]) -> None:
    """Write files aside and put them in place when all of them are whole.

    Args:
        folder: made if missing.
        files: what writes each file, by its name in the folder.

    Raises:
        OSError: a file cannot be written; it names the file, and the folder is as it was before.
    """
    folder.mkdir(parents=True, exist_ok=True)
    aside = Path(tempfile.mkdtemp(prefix=".writing-", dir=folder))
    try:
        for name, write in files.items():
            try:
                write(aside / name)
            except OSError as error:
                raise OSError(error.errno, error.strerror, str(folder / name)) from error
        for name in files:
            (aside / name).replace(folder / name)
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def write_run(record: Record, folder: Path | str) -> None:
    """Write ``summary.json``, ``record.csv`` and ``report.html`` of a run.

    Args:
        record: the run.
        folder: made if missing; an older run's files in it are replaced, all or none.

    Raises:
        OSError: a file cannot be written.
    """
    summary = summarise(record)
    text = (
        json.dumps(summary.to_dict() | what_was_run(record.experiment), indent=2, allow_nan=False)
        + "\n"
    )
    files: dict[str, Write] = {
        "summary.json": lambda path: path.write_text(text, encoding="utf-8"),
        "record.csv": lambda path: write_csv(record, path),
        "report.html": lambda path: path.write_text(render(record, summary), encoding="utf-8"),
    }
    write_together(Path(folder), files)
