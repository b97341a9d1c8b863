"""A plot in the report of a walk or of a study."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

Trace = dict[str, Any]


@dataclass(frozen=True)
class Figure:
    """A plotly figure as plain data, with its heading.

    Args:
        key: name of its element, unique in the page.
        title: heading.
        note: how to read it.
        data: traces of plotly; a trace over time without ``x`` takes the times of the page.
        layout: layout of plotly with a ``height`` [px], see :func:`apnc.report.theme.layout`.
        over_time: whether its x-axis is time [s] and moves with those of the other plots.
    """

    key: str
    title: str
    note: str
    data: list[Trace]
    layout: dict[str, Any]
    over_time: bool = True

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionary for the script of the page that draws the plot."""
        return {
            "key": self.key,
            "data": self.data,
            "layout": self.layout,
            "overTime": self.over_time,
        }
