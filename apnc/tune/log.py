"""The log of a search: every candidate with its cost, from which a search goes on."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc_core.types import Array

CHECK: Final = "check"
"""In place of the number of a candidate: the favourite of the generation was checked."""

_FIRST: Final = ("generation", "candidate", "cost")
"""Columns before those of the design variables."""

Row = tuple[int, str, float, list[float]]
"""Generation, number of the candidate or ``check``, cost, and point of a candidate."""


@dataclass
class Log:
    """A CSV file whose first line says what search it is of.

    The file is begun with the first cost, so that a search that has found none leaves no file.

    Attributes:
        path: the file; None: nothing is written.
    """

    path: Path | None

    def __post_init__(self) -> None:
        """Nothing is read until :meth:`begin`."""
        self._head = ""
        # by number, since a generation that was cut short is walked and written again
        self._known: dict[int, dict[str, tuple[float, list[float]]]] = {}
        self._checks: dict[int, float] = {}

    def begin(self, names: Sequence[str], search: Mapping[str, Any], *, resume: bool) -> None:
        """Read what the file holds; if there is none, prepare one.

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
        self._head = f"# {json.dumps(search, sort_keys=True)}\n{_line([*_FIRST, *names])}"
        if not self.path.exists():
            return
        if not resume:
            raise ValueError(f"{self.path} is the log of an earlier search; allowed: --resume")
        head, rows = _content(self.path)
        own, theirs = _first_line(self._head), _first_line(head)
        for name, value in own.items():
            if theirs.get(name) != value:
                raise ValueError(
                    f"{self.path} is of another search: {name} was {json.dumps(theirs.get(name))} "
                    f"and is {json.dumps(value)}"
                )
        if head != self._head:
            raise ValueError(f"{self.path} is of a search of other numbers")
        for generation, number, cost, x in rows:
            if number == CHECK:
                self._checks[generation] = cost
            else:
                self._known.setdefault(generation, {})[number] = cost, x
        # a kill may have cut the last line short
        _end_in_whole_lines(self.path)

    def costs(self, generation: int, points: Sequence[Array]) -> list[float] | None:
        """Costs of a generation; None if the log does not have all of them.

        Raises:
            ValueError: the log has other points, so that it is of another search.
        """
        known = list(self._known.get(generation, {}).values())
        if len(known) < len(points):
            return None
        found = [x for _, x in known]
        if len(known) > len(points) or not np.allclose(found, points, rtol=0.0, atol=1e-9):
            raise ValueError(f"{self.path} has other candidates in generation {generation}")
        return [cost for cost, _ in known]

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
            self._add(_line([generation, CHECK, repr(cost)]))

    def _add(self, text: str) -> None:
        if self.path is None:
            return
        begun = self.path.exists()
        with self.path.open("a", encoding="utf-8") as file:
            file.write(text if begun else self._head + text)


def read_rows(path: Path) -> list[Row]:
    """Rows of a log, in their order.

    Raises:
        ValueError: the file is no log of a search.
    """
    return _content(path)[1]


def _content(path: Path) -> tuple[str, list[Row]]:
    """First two lines and rows of a log. A line that a kill cut short is left out."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    except UnicodeDecodeError:
        raise ValueError(f"{path} is no log of a search") from None
    head = "".join(lines[:2])
    columns = lines[1].strip().split(",") if len(lines) > 1 else []
    _first_line(head, path)
    if tuple(columns[: len(_FIRST)]) != _FIRST:
        raise ValueError(f"{path} is no log of a search: line 2 has no columns of one")
    rows: list[Row] = []
    for number, line in enumerate(lines[2:], start=3):
        if line.endswith("\n"):
            try:
                rows.append(_row(line.strip().split(","), len(columns)))
            except ValueError:
                raise ValueError(f"{path}, line {number} is no row of a search") from None
    return head, rows


def _first_line(head: str, path: Path | None = None) -> dict[str, Any]:
    """What search a log is of."""
    try:
        found = json.loads(head.partition("\n")[0].removeprefix("#"))
    except json.JSONDecodeError:
        found = None
    if not isinstance(found, dict):
        raise ValueError(f"{path} is no log of a search: line 1 does not say of which")
    return found


def _row(values: Sequence[str], columns: int) -> Row:
    """A row; ValueError for one that is none."""
    generation, number, cost, *x = values
    if len(values) != (len(_FIRST) if number == CHECK else columns):
        raise ValueError
    return int(generation), number, float(cost), [float(value) for value in x]


def _end_in_whole_lines(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    if not text.endswith("\n"):
        path.write_text(text[: text.rindex("\n") + 1], encoding="utf-8")


def _line(values: Sequence[Any]) -> str:
    return ",".join(map(str, values)) + "\n"
