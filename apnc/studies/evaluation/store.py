"""Rows on disk: appended as they come, so that no kill loses a finished trial."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from apnc.studies.evaluation.trial import CONFIGURATION, Row


class Store:
    """Finished trials of one output folder, one JSON object per line.

    Args:
        path: the file, made if it is not there.

    A line that a kill has torn is dropped when the file is opened, and its trial runs again.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}
        if path.is_file():
            self._read()
        self._file = path.open("a", encoding="utf-8")

    def _read(self) -> None:
        whole = 0
        for line in self.path.read_bytes().splitlines(keepends=True):
            if not line.endswith(b"\n"):
                break
            try:
                row = json.loads(line)
            except ValueError:
                break
            self.rows[row["key"]] = row
            whole += len(line)
        with self.path.open("r+b") as file:
            file.truncate(whole)

    def add(self, row: Row) -> None:
        """Append a row; it is on disk when this returns."""
        self.rows[row["key"]] = row
        self._file.write(json.dumps(row) + "\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def write_table(rows: Iterable[Row], path: Path) -> None:
    """Write rows as one tidy CSV, sorted by configuration, whatever order they came in.

    Raises:
        OSError: the file cannot be written.
    """
    listed = sorted(rows, key=_order)
    columns = list(dict.fromkeys(name for row in listed for name in row))
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(listed)


def _order(row: Row) -> tuple[Any, ...]:
    return tuple(row[name] for name in CONFIGURATION)
