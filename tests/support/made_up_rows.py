"""Rows of studies that nobody ran: every cell of a grid with figures by formula."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import Any

from apnc.studies.contenders import ALL

Row = dict[str, Any]
Figures = Callable[[Row], Row]


def made_up(
    axes: Mapping[str, Sequence[Any]],
    figures: Figures,
    methods: Sequence[str] = ALL,
    seeds: int = 6,
    study: str = "mi",
) -> list[Row]:
    """A row per value of every axis, seed and method, with what ``figures`` makes of its cell."""
    rows = []
    for values in product(*axes.values()):
        for seed in range(seeds):
            for method in methods:
                cell = {"method": method, **dict(zip(axes, values, strict=True)), "seed": seed}
                row = {"study": study, "key": f"{len(rows):016x}", "mi": 0.08, "duration": 45.0}
                end = {"fell": False, "version": "0", "end": "complete", "error": ""}
                rows.append(row | cell | end | figures(cell))
    return rows
