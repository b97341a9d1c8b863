"""The log of a search: every candidate with its cost, from which a search goes on."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc_core.types import Array

_CHECK: Final = "check"
"""In place of the number of a candidate: the favourite of the generation was checked."""


@dataclass
class Log:
    """A CSV file whose first line says what search it is of.

    Attributes:
        path: the file; None: nothing is written.
    """

    path: Path | None

    def __post_init__(self) -> None:
        """Nothing is read until :meth:`begin`."""
        self._costs: dict[int, list[float]] = {}
        self._points: dict[int, list[list[float]]] = {}
        self._checks: dict[int, float] = {}

    def begin(self, names: Sequence[str], search: Mapping[str, Any], *, resume: bool) -> None:
        """Begin the file, or read what it holds.

        Args:
            names: of the design variables.
            search: what the search depends on, as plain data.
            resume: read the file and add to it.

        Raises:
            ValueError: there is a file although nothing is to be resumed, or it is of another
                search.
        """
        if self.path is None:
            return
        head = "# " + json.dumps(search, sort_keys=True)
        if resume and self.path.exists():
            self._read(head)
            return
        if self.path.exists():
            raise ValueError(
                f"{self.path} is the log of another search; allowed: --resume, another --output, or "
                "to remove it"
            )
        columns = ["generation", "candidate", "cost", *names]
        self.path.write_text(f"{head}\n{_line(columns)}", encoding="utf-8")

    def _read(self, head: str) -> None:
        assert self.path is not None
        first, *lines = self.path.read_text(encoding="utf-8").splitlines(keepends=True)
        if first.strip() != head:
            raise ValueError(
                f"{self.path} is the log of a search with other settings: {first.strip()}"
            )
        whole = [line for line in lines if line.endswith("\n")]  # a kill may cut the last one short
        for row in csv.DictReader(whole):
            generation, number, cost, *x = row.values()
            if number == _CHECK:
                self._checks[int(generation)] = float(cost)
                continue
            self._costs.setdefault(int(generation), []).append(float(cost))
            self._points.setdefault(int(generation), []).append([float(value) for value in x])
        if len(whole) < len(lines):
            self.path.write_text(first + "".join(whole), encoding="utf-8")

    def costs(self, generation: int, points: Sequence[Array]) -> list[float] | None:
        """Costs of a generation; None if the log does not have all of them.

        Raises:
            ValueError: the log has other points, so that it is of another search.
        """
        known = self._points.get(generation, [])
        if len(known) < len(points):
            return None
        if not np.allclose(known, np.asarray(points), rtol=0.0, atol=1e-9):
            raise ValueError(f"{self.path} has other candidates in generation {generation}")
        return self._costs[generation]

    def write(self, generation: int, points: Sequence[Array], costs: Sequence[float]) -> None:
        """Add a generation."""
        rows = [
            [generation, number, repr(float(cost)), *(repr(float(value)) for value in x)]
            for number, (x, cost) in enumerate(zip(points, costs, strict=True))
        ]
        self._add("".join(map(_line, rows)))

    def check(self, generation: int) -> float | None:
        """Cost of the check after a number of generations; None if the log has none."""
        return self._checks.get(generation)

    def write_check(self, generation: int, cost: float) -> None:
        """Add the cost of a check, unless the log has it."""
        if generation not in self._checks:
            self._checks[generation] = cost
            self._add(_line([generation, _CHECK, repr(cost)]))

    def _add(self, text: str) -> None:
        if self.path is not None:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(text)


def _line(values: Sequence[Any]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(values)
    return text.getvalue()
