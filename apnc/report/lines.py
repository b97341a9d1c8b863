"""What figures over time are made from: the run, its lines, and rows of lines over one axis."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.features import WalkFeatures
from apnc.loop.record import Record
from apnc.report import theme
from apnc.report.encoding import Signal
from apnc.report.figure import Figure, Trace
from apnc.report.samples import Samples
from apnc_core.types import Array
from apnc_plant.signals import PLANT_SIGNALS

STYLES: Final = ({"width": 1.7, "dash": "solid"}, {"width": 1.3, "dash": "dot"})
"""Solid and dotted lines, which differ without colours."""

_ROW: Final = 78
"""Height of a row [px]."""


@dataclass(frozen=True)
class Run:
    """What every figure of a walk is made from.

    Args:
        record: the run, with at least one sample.
        summary: what is measured of it.
    """

    record: Record
    summary: WalkFeatures

    @cached_property
    def samples(self) -> Samples:
        """Which samples are shown."""
        return Samples(self.record.time)

    @cached_property
    def shown(self) -> dict[str, Array]:
        """The signals of the plant at the samples that are shown."""
        return {s.name: self.record.signals[s.name][self.samples.at] for s in PLANT_SIGNALS}

    @cached_property
    def standing(self) -> NDArray[np.bool_]:
        """Which feet stand, shape (T, n)."""
        return metrics.stance(self.record.signals["foot_force"][..., 2])

    @property
    def colours(self) -> dict[str, str]:
        """Colour of every leg."""
        return theme.leg_colours(self.record.legs)

    def line(self, values: Array, name: str, colour: str, **style: Any) -> Trace:
        """A line of a signal of shape (T,) over the time of the page."""
        return line(self.samples.of(values), name, colour, **style)

    def leg_rows(
        self, key: str, title: str, unit: str, series: dict[str, Array], note: str, **axes: Any
    ) -> Figure:
        """A row for each leg, all on one scale.

        Args:
            key, title, note: see :class:`Figure`.
            unit: of the signals.
            series: at most two signals by name, each of shape (T, n).
            axes: of every row, see :func:`apnc.report.theme.axis`.
        """
        styled = list(zip(series.items(), STYLES, strict=False))
        rows = [
            (f"<b>{leg}</b> [{unit}]", [
                self.line(values[:, i], f"{leg} {name}", colour, showlegend=False, **style)
                for (name, values), style in styled
            ])
            for i, (leg, colour) in enumerate(self.colours.items())
        ]  # fmt: skip
        figure = stacked(key, title, note, rows, matches="y", **axes)
        # empty lines, so that the legend shows the styles once and not for each leg
        empty = {"x": [None], "y": [None], "hoverinfo": "skip"}
        figure.data.extend(line(np.empty(0), n, theme.INK, **s) | empty for (n, _), s in styled)
        return figure


def line(values: Array, name: str, colour: str, **style: Any) -> Trace:
    """A line through samples.

    Args:
        values: shape (T,), drawn as they are.
        name: in the legend.
        colour: of the line.
        style: ``width`` and ``dash`` of the line, and further entries of the trace.
    """
    look = {"color": colour, "width": style.pop("width", 1.6), "dash": style.pop("dash", "solid")}
    trace = {"type": "scatter", "mode": "lines", "y": Signal(values), "name": name, "line": look}
    return trace | style


def stacked(
    key: str, title: str, note: str, rows: Sequence[tuple[str, Iterable[Trace]]], **axes: Any
) -> Figure:
    """Rows under one another over one time axis.

    Args:
        key, title, note: see :class:`Figure`.
        rows: title with unit and lines of each.
        axes: of every row, see :func:`apnc.report.theme.axis`.
    """
    names = [f"y{i + 1}" if i else "y" for i in range(len(rows))]
    grid = {"rows": len(rows), "columns": 1, "subplots": [[f"x{y}"] for y in names], "ygap": 0.12}
    time = theme.axis("time [s]", anchor=names[-1])
    layout = theme.layout(80 + _ROW * len(rows), grid=grid, xaxis=time)
    data: list[Trace] = []
    for y, (label, lines) in zip(names, rows, strict=True):
        # plotly refuses an axis that matches itself
        own = {name: value for name, value in axes.items() if (name, value) != ("matches", y)}
        layout[f"yaxis{y[1:]}"] = theme.axis(label, nticks=5, showline=True, mirror=True, **own)
        data += [trace | {"yaxis": y} for trace in lines]
    return Figure(key, title, note, data, layout)
