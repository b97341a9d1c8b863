"""The end of a record in ``record.csv``, read back."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any


def last_row(path: Path) -> dict[str, float]:
    """The last row of a record, by column; empty if it has none.

    Raises:
        ValueError: no such file, no text, or a damaged row; it names the file and the line.
    """
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return _last_of(csv.reader(file, strict=True), path)
    except OSError as error:
        raise ValueError(f"{path} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{path}, line {_first_no_text(path)}: no text") from None


def _last_of(rows: Any, path: Path) -> dict[str, float]:
    last: list[str] = []
    try:
        names: list[str] = next(rows, [])
        for row in filter(None, rows):
            if len(row) != len(names):
                raise ValueError(f"{len(row)} values, where the first line has {len(names)}")
            last = row
        return dict(zip(names, map(float, last), strict=bool(last)))
    except UnicodeDecodeError:
        raise
    except (csv.Error, ValueError) as error:
        raise ValueError(f"{path}, line {rows.line_num}: {error}") from None


def _first_no_text(path: Path) -> int:
    """Number of the first line with bytes that are no text."""
    content = path.read_bytes()
    try:
        content.decode("utf-8")
    except UnicodeDecodeError as error:
        return content.count(b"\n", 0, error.start) + 1
    return 0
