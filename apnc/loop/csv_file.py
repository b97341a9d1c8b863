"""``record.csv``: every signal of a run, a line per tick, SI units throughout."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Final

import numpy as np

from apnc.loop.columns import columns
from apnc.loop.record import Record

_LINES: Final = 4096


def write_csv(record: Record, path: Path) -> None:
    """Write every signal; docs/record.md says what the columns are.

    Raises:
        OSError: the file cannot be written.
    """
    table = columns(record)
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerow(table)
        for begin in range(0, len(record), _LINES):  # in parts: an hour has 200,000 lines
            part = [values[begin : begin + _LINES] for values in table.values()]
            np.savetxt(file, np.column_stack(part), fmt="%.9g", delimiter=",")
