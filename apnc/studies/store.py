"""A file of results. Each is appended when its trial ends.

If the process is killed, the results of all trials that have ended are in the file.
"""

from __future__ import annotations

import contextlib
import json
import os
import time
from collections import defaultdict
from pathlib import Path
from typing import Final

from apnc.studies.results import Result, TrialId, id_of
from build_fmu.locks import locked

SYNC_S: Final = 1.0
"""Shortest time between two calls of fsync [s]. A call takes some milliseconds."""


class Store(contextlib.ExitStack):
    """Results of finished trials, one JSON object per line. The last line of a trial counts.

    Args:
        path: the file. It and its folder are made if missing. None keeps results in memory only.

    Attributes:
        results: by trial. A last line that a kill has cut short is removed.
        wall_s: wall time that each trial took [s], over all runs of the study. It is stored in the
            file beside the result and is not part of it, so that two runs give equal results.

    Raises:
        ValueError: another study writes to the file.
    """

    def __init__(self, path: Path | None) -> None:
        super().__init__()
        self.results: dict[TrialId, Result] = {}
        self.wall_s: defaultdict[TrialId, float] = defaultdict(float)
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
                result = json.loads(line)
                self.results[at := id_of(result)] = result
                self.wall_s[at] += result.pop("wall_s", 0.0)

    def add(self, result: Result) -> None:
        """Append a result.

        The operating system has it when this returns. The disk has it within ``SYNC_S``.

        Raises:
            OSError: the file cannot be written; the message names it.
        """
        before, self._since = self._since, time.perf_counter()
        self.results[at := id_of(result)] = result
        self.wall_s[at] += (wall_s := self._since - before)
        if self._file is None:
            return
        try:
            text = json.dumps(result | {"wall_s": round(wall_s, 3)}, allow_nan=False)
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
