"""Rows in a file, appended as they come: no error, interrupt or kill loses a finished trial."""

from __future__ import annotations

import contextlib
import json
import os
import time
from collections import defaultdict
from pathlib import Path
from typing import Final

from apnc.report.locks import locked
from apnc.studies.rows import Row

SYNC_S: Final = 1.0
"""How often at most the file is put on the disk itself [s]: each time takes some ms."""


def place_of(row: Row) -> tuple[str, str, str]:
    """Where a row stands, see ``Trial.place``."""
    return row["study"], row["method"], row["key"]


class Store(contextlib.ExitStack):
    """Finished trials, one JSON object per line; the last line of a trial counts.

    Args:
        path: the file, made with its folder if it is not there; None keeps the rows in memory.

    Attributes:
        rows: by study, method and key; without a line that a kill has torn, which is dropped.
        wall_s: wall time that went by before each row [s], over all runs of the study; it is in
            the file, but not in the row: two runs give the same rows.

    Raises:
        ValueError: another study writes to the file.
    """

    def __init__(self, path: Path | None) -> None:
        super().__init__()
        self.rows: dict[tuple[str, str, str], Row] = {}
        self.wall_s: defaultdict[tuple[str, str, str], float] = defaultdict(float)
        self._since = self._synced = time.perf_counter()
        self._file = None
        if path is None:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file = self.enter_context(path.open("a+b"))
        if not locked(self._file.fileno(), wait=False):
            self.close()
            raise ValueError(f"{path} is being written by another study; choose another folder")
        self._file.seek(0)
        *lines, torn = self._file.read().split(b"\n")
        self._file.truncate(self._file.tell() - len(torn))
        self.callback(self._sync)
        for line in lines:
            with contextlib.suppress(ValueError, KeyError, TypeError):  # a damaged line
                row = json.loads(line)
                self.rows[at := place_of(row)] = row
                self.wall_s[at] += row.pop("wall_s", 0.0)

    def add(self, row: Row) -> None:
        """Append a row; the operating system has it when this returns, the disk soon after.

        Raises:
            OSError: it cannot be written; the file is named.
        """
        before, self._since = self._since, time.perf_counter()
        self.rows[at := place_of(row)] = row
        self.wall_s[at] += (wall_s := self._since - before)
        if self._file is None:
            return
        try:
            text = json.dumps(row | {"wall_s": round(wall_s, 3)}, allow_nan=False)
            self._file.write(text.encode() + b"\n")
            self._file.flush()
            if self._since - self._synced >= SYNC_S:
                self._sync()
        except OSError as error:
            raise OSError(error.errno, error.strerror, self._file.name) from error

    def _sync(self) -> None:
        assert self._file is not None
        os.fsync(self._file.fileno())
        self._synced = self._since
