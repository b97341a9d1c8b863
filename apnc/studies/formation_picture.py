"""Convergence time and success over MI as one SVG file, in the form of the paper's Fig. 4."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from apnc.report.theme import BLUE, GREEN, GREY, GRID, INK, ORANGE, PURPLE, VERMILLION
from apnc.studies.formation_table import grouped, numbers
from apnc.studies.svg import line, text, upright

WIDTH: Final = 900
LEFT, RIGHT = 64, 18
UPPER: Final = (54, 330)
"""Top and bottom of the panel of times [px]."""
LOWER: Final = (372, 462)
"""Top and bottom of the panel of success [px]."""
COLOURS: Final = (BLUE, ORANGE, GREEN, PURPLE, VERMILLION)


def formation_svg(rows: Sequence[Mapping[str, Any]]) -> str:
    """The picture: boxes of the strict convergence time, marks of success under both criteria.

    Args:
        rows: rows of ``formation.csv``.

    Boxes: quartiles and median; whiskers: farthest value within 1.5 box lengths; dots: values
    beyond. Only trials that converged have a time, so read a box together with its success.
    """
    groups = grouped(rows)
    methods = list(dict.fromkeys(method for method, _ in groups))
    mis = sorted({mi for _, mi in groups})
    times = {group: numbers(members, "convergence_time_s") for group, members in groups.items()}
    longest = max((max(t) for t in times.values() if t), default=1.0)
    top = float(np.ceil(longest / 5.0) * 5.0)
    parts = _frame(mis, top)
    for (method, mi), members in groups.items():
        colour = COLOURS[methods.index(method) % len(COLOURS)]
        x = _x(mis, mi) + _shift(methods, method, mis)
        parts += _box(x, times[method, mi], top, colour, _box_width(methods, mis))
        parts += _marks(x, members, colour)
    parts += _legend(methods)
    body = "\n".join(parts)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} 520" '
        f'font-family="system-ui, sans-serif" font-size="12" fill="{INK}">\n'
        f'<rect width="{WIDTH}" height="520" fill="#ffffff"/>\n{body}\n</svg>\n'
    )


def _slot(mis: Sequence[float]) -> float:
    return (WIDTH - LEFT - RIGHT) / max(1, len(mis))


def _x(mis: Sequence[float], mi: float) -> float:
    return LEFT + (mis.index(mi) + 0.5) * _slot(mis)


def _box_width(methods: Sequence[str], mis: Sequence[float]) -> float:
    return min(26.0, 0.7 * _slot(mis) / len(methods))


def _shift(methods: Sequence[str], method: str, mis: Sequence[float]) -> float:
    return (methods.index(method) - (len(methods) - 1) / 2.0) * _box_width(methods, mis) * 1.15


def _y(value: float, top: float, panel: tuple[int, int]) -> float:
    return panel[1] - (panel[1] - panel[0]) * value / top


def _frame(mis: Sequence[float], top: float) -> list[str]:
    parts = []
    for panel, limit, step, unit in ((UPPER, top, 5.0, "{:.0f}"), (LOWER, 100.0, 50.0, "{:.0f} %")):
        for value in np.arange(0.0, limit + 1e-9, step):
            y = _y(float(value), limit, panel)
            parts.append(line(LEFT, y, WIDTH - RIGHT, y, GRID))
            parts.append(text(LEFT - 8, y + 4, unit.format(value), "end"))
    for mi in mis:
        parts.append(text(_x(mis, mi), LOWER[1] + 20, f"{mi:.2f}"))
    parts.append(text(WIDTH / 2, LOWER[1] + 44, "modulatory input MI [1]"))
    parts.append(upright(18, sum(UPPER) / 2, "strict convergence time [s]"))
    parts.append(upright(18, sum(LOWER) / 2, "success"))
    return parts


def _box(x: float, values: list[float], top: float, colour: str, width: float) -> list[str]:
    if not values:
        return []
    low, middle, high = (float(v) for v in np.percentile(values, [25, 50, 75]))
    reach = 1.5 * (high - low)
    inside = [v for v in values if low - reach <= v <= high + reach]
    y = {v: _y(v, top, UPPER) for v in (low, middle, high, min(inside), max(inside))}
    half = width / 2.0
    parts = [
        line(x, y[min(inside)], x, y[low], colour),
        line(x, y[high], x, y[max(inside)], colour),
        f'<rect x="{x - half:.1f}" y="{y[high]:.1f}" width="{width:.1f}" '
        f'height="{max(1.0, y[low] - y[high]):.1f}" fill="{colour}" fill-opacity="0.3" '
        f'stroke="{colour}"/>',
        line(x - half, y[middle], x + half, y[middle], colour, 2.5),
    ]
    beyond = [v for v in values if not low - reach <= v <= high + reach]
    return parts + [
        f'<circle cx="{x:.1f}" cy="{_y(v, top, UPPER):.1f}" r="2" fill="{colour}"/>' for v in beyond
    ]


def _marks(x: float, members: Sequence[Mapping[str, Any]], colour: str) -> list[str]:
    strict = 100.0 * sum(numbers(members, "converged")) / len(members)
    loose = 100.0 * len(numbers(members, "convergence_time_authors_s")) / len(members)
    y, y_loose = _y(strict, 100.0, LOWER), _y(loose, 100.0, LOWER)
    return [
        f'<circle cx="{x:.1f}" cy="{y_loose:.1f}" r="6" fill="none" stroke="{colour}"/>',
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>',
    ]


def _legend(methods: Sequence[str]) -> list[str]:
    parts, x = [], float(LEFT)
    for n, method in enumerate(methods):
        colour = COLOURS[n % len(COLOURS)]
        parts.append(
            f'<rect x="{x:.0f}" y="20" width="16" height="12" fill="{colour}" fill-opacity="0.3" '
            f'stroke="{colour}"/>'
        )
        parts.append(text(x + 22, 30, method, "start"))
        x += 36.0 + 8.0 * len(method)
    parts.append(f'<circle cx="{x + 24:.0f}" cy="26" r="3.5" fill="{GREY}"/>')
    parts.append(text(x + 34, 30, "success, strict criterion", "start"))
    parts.append(f'<circle cx="{x + 204:.0f}" cy="26" r="6" fill="none" stroke="{GREY}"/>')
    parts.append(text(x + 216, 30, "success, authors' criterion", "start"))
    return parts
