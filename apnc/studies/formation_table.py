"""The formation study as a Markdown table, a line per method and MI."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.stats import binomtest

Row = Mapping[str, Any]

_HEAD = (
    "| method | MI | trot kept, strict | 95 % interval | strict time [s], median (quartiles; "
    "longest) | authors' criterion | authors' time [s], median | speed [m/s], median (range) "
    "| fell |\n|---|---|---|---|---|---|---|---|---|\n"
)


def success_interval(successes: int, trials: int) -> tuple[float, float]:
    """Exact 95 % interval of a success rate (Clopper and Pearson 1934).

    Raises:
        ValueError: no trials.
    """
    if trials < 1:
        raise ValueError("an interval needs at least one trial")
    interval = binomtest(successes, trials).proportion_ci(0.95, method="exact")
    return float(interval.low), float(interval.high)


def grouped(rows: Sequence[Row]) -> dict[tuple[str, float], list[Row]]:
    """Rows by method and MI, in the order in which they first appear."""
    groups: dict[tuple[str, float], list[Row]] = {}
    for row in rows:
        groups.setdefault((str(row["method"]), float(row["mi"])), []).append(row)
    return groups


def numbers(rows: Sequence[Row], name: str) -> list[float]:
    """The entries ``name`` that are there."""
    return [float(row[name]) for row in rows if row.get(name) not in (None, "")]


def formation_markdown(rows: Sequence[Row]) -> str:
    """The table; a trial that raised counts as a failure.

    Args:
        rows: rows of ``formation.csv``.
    """
    return _HEAD + "".join(_line(*group) for group in grouped(rows).items())


def _line(group: tuple[str, float], rows: list[Row]) -> str:
    n, good = len(rows), int(sum(numbers(rows, "converged")))
    low, high = success_interval(good, n)
    strict = numbers(rows, "convergence_time_s")
    loose = numbers(rows, "convergence_time_authors_s")
    speed = numbers(rows, "late_speed_m_per_s")
    entries = (
        group[0],
        f"{group[1]:.2f}",
        f"{good}/{n}",
        f"{100 * low:.0f} ... {100 * high:.0f} %",
        _spread(strict),
        f"{len(loose)}/{n}",
        f"{np.median(loose):.1f}" if loose else "-",
        f"{np.median(speed):.3f} ({min(speed):.3f} ... {max(speed):.3f})" if speed else "-",
        f"{int(sum(numbers(rows, 'fell')))}",
    )
    return f"| {' | '.join(entries)} |\n"


def _spread(values: list[float]) -> str:
    if not values:
        return "-"
    low, middle, high = np.percentile(values, [25, 50, 75])
    return f"{middle:.1f} ({low:.1f} ... {high:.1f}; {max(values):.1f})"
