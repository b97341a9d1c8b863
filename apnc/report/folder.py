"""The folder of a run: summary, record and report, of one run and whole, or not at all."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from apnc.features import WalkFeatures, walk_features
from apnc.loop.columns import column_names
from apnc.loop.csv_file import write_csv
from apnc.loop.provenance import what_was_run
from apnc.loop.record import Record
from apnc.report import RUN_FILES
from apnc.report.locks import one_at_a_time
from apnc.report.page import render

Write = Callable[[Path], object]
_ASIDE: Final = ".writing-"

LEFT_S: Final = 86400.0
"""Age from which on what lies aside was left by a killed writer: no file takes a day [s]."""


def write_together(folder: Path, files: Mapping[str, Write]) -> None:
    """Write files aside and put them in place when all of them are whole.

    Any number may write to a folder at a time; of those that write the same files the last one's
    stay, all of them.

    Args:
        folder: made if missing.
        files: what writes each file, by its name in the folder.

    Raises:
        OSError: a file cannot be written; it names the file, and the folder is as it was before.
    """
    folder.mkdir(parents=True, exist_ok=True)
    aside = Path(tempfile.mkdtemp(prefix=_ASIDE, dir=folder))
    try:
        _remove_what_was_left(folder, aside.stat().st_mtime)
        for name, write in files.items():
            with _naming(folder / name):
                write(aside / name)
        with one_at_a_time(folder):
            _exchange(aside, folder, list(files))
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _remove_what_was_left(folder: Path, now: float) -> None:
    """Remove what killed writers left aside, by the clock of the file system."""
    for left in folder.glob(f"{_ASIDE}*"):
        with suppress(OSError):  # another has removed it
            if now - left.stat().st_mtime > LEFT_S:
                shutil.rmtree(left, ignore_errors=True)


def _exchange(aside: Path, folder: Path, names: list[str]) -> None:
    """Move the new files in; the older ones leave first, so that the two never stand together."""
    older = aside / "older"
    older.mkdir()
    done: list[tuple[Path, Path]] = []
    present = [name for name in names if (folder / name).exists()]
    moves = [(folder / name, older / name) for name in present]
    moves += [(aside / name, folder / name) for name in names]
    try:
        for source, target in moves:
            with _naming(folder / source.name):
                source.rename(target)
            done.append((source, target))
    except BaseException:
        for source, target in reversed(done):
            target.rename(source)
        raise


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Says in an error of the file system which file it was, by the name it was to have."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def write_run(record: Record, folder: Path | str) -> WalkFeatures:
    """Write ``summary.json``, ``record.csv`` and ``report.html`` of a run.

    Args:
        record: the run, however it ended.
        folder: made if missing; an older run's files in it are replaced, all or none.

    Returns:
        Its key figures.

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
    """Text of ``summary.json``: key figures, what was run, and units of the columns."""
    units = {"columns": {column.name: column.unit for column in column_names(record)}}
    content = summary.to_dict() | what_was_run(record.experiment, record.parameters) | units
    return json.dumps(content, indent=2, allow_nan=False) + "\n"
