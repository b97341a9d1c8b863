"""Rows of the table: what was measured, in every round, against what, and what it should be."""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Row:
    """A figure of every round; all of them are costs, so less is better.

    Args:
        what: what was measured.
        unit: of the values.
        values: one per round.
        against: what it is compared with; empty if nothing.
        others: values of that in the same rounds.
        least: times as fast as that which it should be at least; None: no aim.
        most: what the value should be at most; None: no aim.
        note: what else there is to say.
    """

    what: str
    unit: str
    values: tuple[float, ...]
    against: str = ""
    others: tuple[float, ...] = ()
    least: float | None = None
    most: float | None = None
    note: str = ""

    @property
    def ratio(self) -> float | None:
        """Times as fast as the other, the median over the rounds."""
        pairs = zip(self.values, self.others, strict=True) if self.others else ()
        ratios = [other / own for own, other in pairs]
        return statistics.median(ratios) if ratios else None

    @property
    def ratio_of_least(self) -> float | None:
        """Times as fast as the other, each in its fastest round."""
        return min(self.others) / min(self.values) if self.others else None

    @property
    def met(self) -> str:
        """Whether the aim is met, by the median; empty without an aim."""
        if self.least is not None and self.ratio is not None:
            return _met(self.ratio / self.least)
        if self.most is not None:
            return _met(self.most / statistics.median(self.values))
        return ""

    @property
    def aim(self) -> str:
        """The aim in words."""
        if self.least is not None:
            return f"at least {self.least:g} times"
        return "" if self.most is None else f"at most {self.most:g} {self.unit}"

    def to_dict(self) -> dict[str, Any]:
        """Plain data, with what follows from the values."""
        found = {"ratio": self.ratio, "ratio_of_least": self.ratio_of_least, "met": self.met}
        return asdict(self) | found


def _met(share: float) -> str:
    return "yes" if share >= 1.0 else f"no, {100.0 * (1.0 / share - 1.0):.0f} % off"


def in_turn(
    measures: Mapping[str, Callable[[], float]], rounds: int
) -> dict[str, tuple[float, ...]]:
    """What every measure gives in every round, by name.

    They run one after the other, in every second round from the last to the first, so that what
    drifts over the rounds hits all alike. A run of each before the first round does not count.
    """
    found: dict[str, list[float]] = {name: [] for name in measures}
    for measure in measures.values():
        measure()
    names = list(measures)
    for index in range(rounds):
        for name in names if index % 2 == 0 else reversed(names):
            found[name].append(measures[name]())
    return {name: tuple(values) for name, values in found.items()}


def processor_s(work: Callable[[], object], repeats: int = 1) -> float:
    """Time of the processor that a call takes [s], the mean: other programs do not count."""
    begin = time.process_time()
    for _ in range(repeats):
        work()
    return (time.process_time() - begin) / repeats


def wall_s(work: Callable[[], object]) -> float:
    """Time that a call takes [s]."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def children_s() -> float:
    """Time of the processor of all processes that this one has started and that have ended [s]."""
    used = os.times()
    return used.children_user + used.children_system


def markdown(rows: Iterable[Row]) -> str:
    """The rows as a table."""
    head = (
        "what", "unit", "rounds", "least", "median", "against", "times as fast", "least by least",
        "aim", "met", "note",
    )  # fmt: skip
    lines = ["| " + " | ".join(cells) + " |" for cells in (head, ["---"] * len(head))]
    for row in rows:
        cells = (
            row.what, row.unit, str(len(row.values)), _number(min(row.values)),
            _number(statistics.median(row.values)), row.against, _number(row.ratio),
            _number(row.ratio_of_least), row.aim, row.met, row.note,
        )  # fmt: skip
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _number(value: float | None) -> str:
    """Three digits, more if they are before the point."""
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 100.0 else f"{value:.3g}"
