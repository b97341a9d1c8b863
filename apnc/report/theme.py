"""Colours and the common look of all plots."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from apnc_plant.robot.leg_names import by_place

# Colours of Okabe and Ito (2008), which people with colour vision deficiencies can tell apart;
# without yellow, which is hard to see on white.
BLUE: Final = "#0072B2"
ORANGE: Final = "#E69F00"
GREEN: Final = "#009E73"
PURPLE: Final = "#CC79A7"
VERMILLION: Final = "#D55E00"
SKY: Final = "#56B4E9"
BLACK: Final = "#111418"
INK: Final = "#1f2933"
GREY: Final = "#8a94a0"
GRID: Final = "#e7eaee"
PAPER: Final = "#ffffff"
EDGE: Final = "#c8ced6"
BAND: Final = "rgba(31, 41, 51, 0.07)"

DARK: Final = {
    BLACK: "#eef1f5",
    INK: "#d5dbe2",
    GREY: "#8a94a0",
    GRID: "#2b323b",
    BAND: "rgba(213, 219, 226, 0.10)",
    PAPER: "#1a1f26",
    EDGE: "#4a535e",
}
"""What the page draws in place of these colours where a dark page is preferred."""

_BY_PLACE: Final = {
    "right front": BLUE,
    "right hind": ORANGE,
    "left front": GREEN,
    "left hind": PURPLE,
    "right middle": VERMILLION,
    "left middle": SKY,
}


def leg_colours(legs: Sequence[str]) -> dict[str, str]:
    """Colour of each leg by its place, the same in every plot and in the animation."""
    own = {leg: _BY_PLACE[place] for place, leg in reversed(by_place(tuple(legs)).items())}
    spare = [colour for colour in _BY_PLACE.values() if colour not in own.values()] + [INK, GREY]
    others = [leg for leg in legs if leg not in own]
    fallback = {leg: spare[i % len(spare)] for i, leg in enumerate(others)}
    return {leg: own.get(leg) or fallback[leg] for leg in legs}


def axis(title: str, **more: Any) -> dict[str, Any]:
    """An axis of plotly with a title, a faint grid and no zero line; ``more`` adds entries."""
    common = {
        "title": {"text": title, "standoff": 8},
        "gridcolor": GRID,
        "zeroline": False,
        "linecolor": EDGE,
        "ticks": "outside",
        "tickcolor": EDGE,
        "ticklen": 4,
    }
    return common | more


def layout(height: int, **more: Any) -> dict[str, Any]:
    """Layout of a plot.

    The margins on the left and right are fixed, so that all time axes are aligned.

    Args:
        height: of the plot [px].
        more: further entries of the layout of plotly.
    """
    common = {
        "height": height,
        "margin": {"l": 74, "r": 46, "t": 34, "b": 44},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": PAPER,
        "font": {"family": "system-ui, 'Segoe UI', Roboto, sans-serif", "size": 12, "color": INK},
        "hovermode": "x unified",
        "legend": {
            "orientation": "h",
            "x": 0,
            "xanchor": "left",
            "y": 1.0,
            "yanchor": "bottom",
            "bgcolor": "rgba(255,255,255,0)",
        },
        "hoverlabel": {"font": {"size": 12, "color": INK}, "bgcolor": PAPER, "bordercolor": EDGE},
        "modebar": {"bgcolor": "rgba(0,0,0,0)", "color": "#b3bbc5", "activecolor": BLUE},
    }
    return common | more
