"""Logs of searches, files ``search.csv``."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from build_fmu.writing import write_atomically


class LogLine(NamedTuple):
    """A line of a log.

    Args:
        log: the file.
        number: of the line in the file, from 1.
        texts: by column; None where the line is cut short.
    """

    log: Path
    number: int
    texts: dict[str, str | None]

    @property
    def is_mean(self) -> bool:
        """Whether it holds the mean of a generation, not a candidate."""
        return (self.texts["generation"] or "").startswith("mean")

    def numbers(self, names: Iterable[str]) -> dict[str, float]:
        """Values of the columns ``names``.

        Raises:
            ValueError: a value is missing or is no finite number.
        """
        return {name: self._number(name) for name in names}

    def _number(self, name: str) -> float:
        text = self.texts[name]
        try:
            value = float(text or "")
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            said = "missing" if text is None else repr(text)
            raise ValueError(
                f"{self.log} line {self.number}: {name} is {said}; allowed: a finite number"
            )
        return value


def read_log(log: Path, needed: Iterable[str] = ()) -> tuple[list[str], list[LogLine]]:
    """Columns and lines of a log.

    Args:
        log: the file.
        needed: columns that it must have, besides ``generation``.

    Raises:
        ValueError: the file is no log of a search with these columns.
        OSError: the file cannot be read.
    """
    try:
        with log.open(newline="", encoding="utf-8") as file:
            table = csv.DictReader(file)
            lines = [LogLine(log, table.line_num, line) for line in table]
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{log} is no log of a search: {error}") from None
    columns = list(table.fieldnames or ())
    for name in ("generation", *needed):
        if name not in columns:
            raise ValueError(f"{log} has no column '{name}'; it is no log of this search")
    return columns, lines


def write_table(path: Path, table: Iterable[Sequence[str]]) -> None:
    """Write a table at once, so that a kill cuts no line short.

    Raises:
        OSError: the file cannot be written; an older one stays.
    """
    text = io.StringIO(newline="")
    csv.writer(text).writerows(table)
    write_atomically(path, text.getvalue().encode())


def keep_logs(output: Path, logs: Iterable[Path]) -> None:
    """Refuse an output that would overwrite a log that is read.

    Raises:
        ValueError: they are one file.
    """
    for log in logs:
        if output.exists() and log.exists() and output.samefile(log):
            raise ValueError(f"{output} would overwrite the log {log}; choose another output")
