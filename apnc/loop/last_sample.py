"""The last sample of a record, read back from ``record.csv``."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any


def last_sample(path: Path) -> dict[str, float]:
    """Values of the last line of ``record.csv`` by column; empty if there is none.

    Raises:
        ValueError: the file cannot be read, is not text, or a line is damaged; the message names
            the file and the line.
    """
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return _last_line(csv.reader(file, strict=True), path)
    except OSError as error:
        raise ValueError(f"{path} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{path}, line {_first_line_not_utf8(path)}: no text") from None


def _last_line(lines: Any, path: Path) -> dict[str, float]:
    last: list[str] = []
    try:
        names: list[str] = next(lines, [])
        for line in filter(None, lines):
            if len(line) != len(names):
                raise ValueError(f"{len(line)} values, where the first line has {len(names)}")
            last = line
        return dict(zip(names, map(float, last), strict=bool(last)))
    except UnicodeDecodeError:
        raise
    except (csv.Error, ValueError) as error:
        raise ValueError(f"{path}, line {lines.line_num}: {error}") from None


def _first_line_not_utf8(path: Path) -> int:
    """Number of the first line with bytes that are not UTF-8; 0 if there is none."""
    content = path.read_bytes()
    try:
        content.decode("utf-8")
    except UnicodeDecodeError as error:
        return content.count(b"\n", 0, error.start) + 1
    return 0
