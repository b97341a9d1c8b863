"""Rows of trials, and what is picked from them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

from apnc import metrics
from apnc.studies.contenders import CONTENDERS, contender

Row = dict[str, Any]

STRICT: Final = "convergence_time_s"
AUTHORS: Final = "convergence_time_authors_s"
SPEED: Final = "path_speed_m_per_s"
PHASE: Final = "phi_final_1"
"""Begin of the columns of the phases at the end; the leg's number follows."""


def is_number(value: Any) -> bool:
    """Whether an entry of a row is a number that statistics may use."""
    return isinstance(value, int | float) and math.isfinite(value)


def matching(rows: Sequence[Row], **where: Any) -> list[Row]:
    """The rows that have these entries."""
    return [row for row in rows if all(row.get(name) == value for name, value in where.items())]


def values(rows: Sequence[Row], column: str, **where: Any) -> list[float]:
    """Numbers of a column in the rows that match ``where``."""
    return [float(r[column]) for r in matching(rows, **where) if is_number(r.get(column))]


def successes(rows: Sequence[Row], column: str = STRICT, **where: Any) -> list[bool]:
    """Whether the gait formed by a criterion and the robot stands, for every row that matches."""
    return [is_number(r.get(column)) and not r.get("fell") for r in matching(rows, **where)]


def phases_in(rows: Sequence[Row]) -> list[str]:
    """Columns of the relative phases at the end, as many as any row has."""
    found = {name for row in rows for name in row if name.startswith(PHASE)}
    return sorted(found, key=lambda name: int(name.removeprefix(PHASE)))


def gait_in(rows: Sequence[Row]) -> str:
    """Name of the gait expected of the robot that walked."""
    return metrics.gait_name(len(phases_in(rows)) + 1)


def methods_in(rows: Sequence[Row]) -> list[str]:
    """Labels that occur, in the order of the contenders.

    Raises:
        ValueError: an unknown label.
    """
    found = {row["method"]: contender(row["method"]) for row in rows}
    return [label for label in CONTENDERS if label in found]


def cells_in(rows: Sequence[Row], axis: str) -> list[Any]:
    """Values along an axis that occur, in order."""
    return sorted({row[axis] for row in rows})
