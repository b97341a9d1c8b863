"""Markdown tables and their cells."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np


def markdown(lines: Iterable[Mapping[str, str]]) -> str:
    """A Markdown table.

    Args:
        lines: texts of each line by title of the column. All lines have the same titles.
    """
    listed = list(lines)
    titles = list(listed[0]) if listed else []
    body = [list(entries.values()) for entries in listed]
    cells = [titles, ["---"] * len(titles), *body]
    return "".join(f"| {' | '.join(entries)} |\n" for entries in cells)


def middle(numbers: Sequence[float], digits: int) -> str:
    """Median, with smallest and largest number in brackets; a dash if there is no number."""
    if not numbers:
        return "-"
    low, value, high = (f"{v:.{digits}f}" for v in np.percentile(numbers, [0, 50, 100]))
    return f"{value} ({low} ... {high})"
