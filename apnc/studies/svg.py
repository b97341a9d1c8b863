"""The few SVG elements that the pictures of the studies are made of; lengths in px."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape


def line(x1: float, y1: float, x2: float, y2: float, colour: str, width: float = 1.0) -> str:
    """A straight line."""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
        f'stroke="{colour}" stroke-width="{width:g}"/>'
    )


def path(points: Sequence[tuple[float, float]], colour: str, width: float = 1.0) -> str:
    """A curve through points (x, y); it is interrupted where one is not a number."""
    commands, drawing = [], False
    for x, y in points:
        if math.isnan(x) or math.isnan(y):
            drawing = False
            continue
        commands.append(f"{'L' if drawing else 'M'}{x:.1f} {y:.1f}")
        drawing = True
    data = "".join(commands)
    return f'<path d="{data}" fill="none" stroke="{colour}" stroke-width="{width:g}"/>'


def rectangle(x: float, y: float, width: float, height: float, colour: str) -> str:
    """A filled rectangle."""
    return (
        f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{colour}"/>'
    )


def text(x: float, y: float, label: str, anchor: str = "middle", weight: str = "normal") -> str:
    """A label; ``anchor`` is start, middle or end."""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-weight="{weight}">'
        f"{escape(label)}</text>"
    )


def upright(x: float, y: float, label: str) -> str:
    """A label that reads upwards, centred."""
    return (
        f'<text transform="translate({x:.0f},{y:.0f}) rotate(-90)" text-anchor="middle">'
        f"{escape(label)}</text>"
    )
