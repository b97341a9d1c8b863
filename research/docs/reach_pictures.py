"""Pictures of how far the gait carries, from the counts of its studies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import plotly.io
from plotly.subplots import make_subplots

from apnc.controllers import named_controller
from apnc.report import theme
from research import robustness
from research.basin import ends, pushes
from research.docs import DOCS
from research.docs.pictures import pictures
from research.limits import lines_of
from research.limits.cases import LIMITS
from research.robustness import numbers
from research.robustness.walks import WALKS

Row = dict[str, Any]
Rows = Sequence[Row]

BAR_PX: Final = 21
"""Height of a line of bars."""

GAP_PX: Final = 78
"""Between two rows of panels, for the title of an axis."""

WALK_COLOURS: Final = (
    theme.SKY, theme.BLUE, theme.GREEN, theme.ORANGE, theme.VERMILLION, theme.PURPLE,
)  # fmt: skip


def _save(name: str, plot: Any) -> None:
    page = plotly.io.to_html(plot, include_plotlyjs=True, div_id=name)
    (DOCS / "pictures" / f"{name}.svg").write_text(pictures(page)[name], encoding="utf-8")


def one_body(shares: Rows, off: Rows) -> Any:
    """Is it tuned to one body? Bodies by chance above, one number at a time below."""
    labels = list(dict.fromkeys(row["controller"] for row in shares))
    factors, shifts = (numbers.bars(off, shifts=which) for which in (False, True))
    lines = [len(bars[0]["y"]) for bars in (factors, shifts)]
    heights = [300, *(24 + BAR_PX * count for count in lines)]
    total = sum(heights) + 2 * GAP_PX
    plot = make_subplots(
        rows=3,
        cols=len(labels),
        specs=[
            [{}] * len(labels),
            *([{"colspan": len(labels)}, *[None] * (len(labels) - 1)] for _ in range(2)),
        ],
        row_heights=heights,
        vertical_spacing=GAP_PX / total,
        subplot_titles=[named_controller(label).name for label in labels],
    )
    for column, label in enumerate(labels, start=1):
        own = [row for row in shares if row["controller"] == label]
        for walk, colour in zip(WALKS, WALK_COLOURS, strict=True):
            for trace in robustness.shares_formed(own, walk):
                look = {"line": {"color": colour, "width": 1.8}, "showlegend": column == 1}
                look |= {"marker": {"color": colour, "size": 6}, "name": walk, "legendgroup": walk}
                plot.add_trace(trace | look, row=1, col=column)
        plot.update_xaxes(row=1, col=column, **theme.axis("every number is off by at most [%]"))
        plot.update_yaxes(row=1, col=column, **theme.axis("", range=[-4, 104]))
    plot.update_yaxes(row=1, col=1, title="bodies with a strict gait [%]")
    for row, bars, axis in ((2, factors, numbers.FACTORS), (3, shifts, numbers.SHIFTS)):
        for trace in bars:
            plot.add_trace(trace, row=row, col=1)
        plot.update_xaxes(row=row, col=1, **axis)
        plot.update_yaxes(row=row, col=1, **theme.axis("", automargin=True))
    plot.update_layout(theme.layout(total + 154, barmode="group", hovermode=False))
    plot.update_layout(margin={"l": 190, "t": 110})
    plot.update_layout(legend={"y": 1.03, "entrywidth": 130, "traceorder": "normal"})
    return plot


def ends_of(rows: Rows) -> Any:
    """When walks reach the gait that they end in, a panel per MI."""
    mis = sorted({float(row["mi"]) for row in rows})
    own = [[row for row in rows if float(row["mi"]) == mi] for mi in mis]
    called = [ends.places(each) for each in own]
    longest = max(float(row["high_s"] or 0.0) for row in ends.commonest(rows))
    plot = make_subplots(
        rows=1,
        cols=len(mis),
        horizontal_spacing=0.26,
        subplot_titles=[f"MI {mi:.2f}" for mi in mis],
    )
    for column, (each, names) in enumerate(zip(own, called, strict=True), start=1):
        for trace in ends.times(each):
            group = {"legendgroup": trace["name"], "showlegend": column == 1}
            plot.add_trace(trace | group, row=1, col=column)
        seconds = theme.axis("reached after [s]", range=[-0.03 * longest, 1.05 * longest])
        plot.update_xaxes(row=1, col=column, **seconds)
        ticks = {"tickvals": list(names.values()), "ticktext": list(names)}
        plot.update_yaxes(row=1, col=column, **theme.axis("", automargin=True, **ticks))
    plot.update_layout(theme.layout(130 + 2 * BAR_PX * len(called[0]), hovermode=False))
    plot.update_layout(margin={"l": 160, "t": 80}, legend={"y": 1.1})
    return plot


def polar(rows: Rows) -> Any:
    """Largest push that is forgotten over its direction."""
    (figure,) = pushes.figures_of(rows)
    plot = make_subplots(rows=1, cols=1, specs=[[{"type": "polar"}]])
    plot.add_traces(figure.data)
    plot.update_layout(figure.layout)
    return plot


def limits_of(rows: Rows) -> Any:
    """A panel per limit: share of the runs that work over its value."""
    names = [name for name in LIMITS if any(row["limit"] == name for row in rows)]
    columns = 3
    count = -(-len(names) // columns)
    plot = make_subplots(
        rows=count, cols=columns, vertical_spacing=0.3 / count, horizontal_spacing=0.06
    )
    for place, name in enumerate(names):
        row, column = place // columns + 1, place % columns + 1
        for trace in lines_of(rows, name):
            group = {"legendgroup": trace["name"], "showlegend": place == 0}
            plot.add_trace(trace | group, row=row, col=column)
        axis = theme.axis(f"{name} [{LIMITS[name].unit}]")
        if LIMITS[name].values[0] > LIMITS[name].values[-1]:
            axis["autorange"] = "reversed"
        plot.update_xaxes(row=row, col=column, **axis)
        plot.update_yaxes(row=row, col=column, **theme.axis("", range=[-6, 106]))
    for row in range(1, count + 1):
        plot.update_yaxes(row=row, col=1, title="runs that work [%]")
    plot.update_layout(theme.layout(230 * count + 40, hovermode=False))
    return plot


def draw(rows: Mapping[str, Rows]) -> None:
    """Write all pictures.

    Args:
        rows: counts by name of the study.
    """
    _save("one-body", one_body(rows["robustness"], rows["robustness.numbers"]))
    _save("basin", ends_of(rows["basin"]))
    _save("pushes", polar(rows["basin.pushes"]))
    _save("limits", limits_of(rows["limits"]))
