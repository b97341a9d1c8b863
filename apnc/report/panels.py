"""Rows of lines over one time axis, and the lines in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc.loop.record import Record
from apnc.report import theme
from apnc.report.encoding import float32
from apnc.report.figure import Figure, Trace
from apnc.report.samples import Samples
from apnc.summary import Summary

Array = NDArray[np.float64]

# Solid and dotted: told apart without colours.
STYLES: Final = ({"width": 1.7, "dash": "solid"}, {"width": 1.3, "dash": "dot"})
_ROW: Final = 78


@dataclass(frozen=True)
class Run:
    """What every panel is made from."""

    record: Record
    summary: Summary
    samples: Samples

    @property
    def colours(self) -> dict[str, str]:
        """Colour of every leg."""
        return theme.leg_colours(self.record.legs)

    def line(self, values: Array, name: str, colour: str, **style: Any) -> Trace:
        """Line over the time of the page of a signal of shape (T,)."""
        return line(self.samples.of(values), name, colour, **style)

    def per_leg(self, values: Array) -> list[Trace]:
        """One line per leg, in its colour."""
        legs = enumerate(self.colours.items())
        return [self.line(values[:, i], leg, colour) for i, (leg, colour) in legs]

    def leg_rows(
        self,
        key: str,
        title: str,
        unit: str,
        series: dict[str, Array],
        note: str,
        limits: tuple[float, float] | None = None,
    ) -> Figure:
        """A row per leg, all on the same scale.

        Args:
            key, title, note: of the figure.
            unit: of the signals.
            series: signals of shape (T, n) by name, at most two.
            limits: what the rows show to begin with; all of the data if omitted.
        """
        rows = []
        for i, (leg, colour) in enumerate(self.colours.items()):
            lines = [
                self.line(values[:, i], f"{leg} {name}", colour, showlegend=False, **style)
                for (name, values), style in zip(series.items(), STYLES, strict=False)
            ]
            rows.append((f"<b>{leg}</b> [{unit}]", lines))
        shared: dict[str, Any] = {"matches": "y"} | ({"range": list(limits)} if limits else {})
        figure = stacked(key, title, note, rows, **shared)
        # The legend explains the styles once, not once per leg.
        empty = {"x": [None], "y": [None], "hoverinfo": "skip"}
        for name, style in zip(series, STYLES, strict=False):
            figure.data.append(line(np.empty(0), name, theme.INK, **style) | empty)
        return figure


def line(values: Array, name: str, colour: str, **style: Any) -> Trace:
    """A line of samples as they are; ``style`` may set width and dash, the rest is the trace's."""
    look = {"color": colour, "width": style.pop("width", 1.6), "dash": style.pop("dash", "solid")}
    return {"type": "scatter", "mode": "lines", "y": float32(values), "name": name, "line": look} | style


def stacked(
    key: str, title: str, note: str, rows: Sequence[tuple[str, list[Trace]]], **axes: Any
) -> Figure:
    """Rows under one another over one time axis: title with unit and lines of each."""
    names = [f"y{i + 1}" if i else "y" for i in range(len(rows))]
    grid = {"rows": len(rows), "columns": 1, "subplots": [[f"x{y}"] for y in names], "ygap": 0.12}
    time = theme.axis("time [s]", anchor=names[-1])
    layout = theme.layout(80 + _ROW * len(rows), grid=grid, xaxis=time)
    for y, (label, _) in zip(names, rows, strict=True):
        more = {"nticks": 3, "showline": True, "mirror": True, **axes}
        if more.get("matches") == y:
            del more["matches"]
        layout[f"yaxis{y[1:]}"] = theme.axis(label, **more)
    data = [
        trace | {"yaxis": y} for y, (_, lines) in zip(names, rows, strict=True) for trace in lines
    ]
    return Figure(key, title, note, data, layout)
