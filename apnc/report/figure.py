"""The one kind of plot: what the report of a walk and that of a study are made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

Trace = dict[str, Any]


@dataclass(frozen=True)
class Figure:
    """A plotly figure as plain data, with its heading.

    Args:
        key: name of its element in the page, unique there.
        title: heading.
        note: how to read it.
        data: traces; one over time without ``x`` is drawn over the time vector of the page.
        layout: plotly layout, see :func:`apnc.report.theme.layout`; ``height`` [px] must be there.
        over_time: its x-axis is time [s] and moves with the others of the page.
    """

    key: str
    title: str
    note: str
    data: list[Trace]
    layout: dict[str, Any]
    over_time: bool = True

    def to_dict(self) -> dict[str, Any]:
        """What the script of the page draws."""
        return {
            "key": self.key,
            "data": self.data,
            "layout": self.layout,
            "overTime": self.over_time,
        }
