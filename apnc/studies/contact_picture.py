"""The picture of the step-size study: two charts in one SVG file, nothing else needed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Protocol

from apnc.loop.recording import Array

WIDTH: Final = 860
HEIGHT: Final = 340
COLOURS: Final = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")


class Measured(Protocol):
    """What the picture shows of a row of the study."""

    @property
    def damping_depth_mm(self) -> float:
        """Depth over which damping sets in [mm]."""

    @property
    def step_ms(self) -> float:
        """Integration step [ms]."""

    @property
    def force_error(self) -> float:
        """Relative error of the forces [1]."""

    @property
    def chatter(self) -> float:
        """Share of chattering steps [1]."""


@dataclass(frozen=True)
class Axes:
    """A rectangle of the picture and the range of values it shows; logarithmic if so asked."""

    left: float
    right: float
    x: tuple[float, float]
    y: tuple[float, float]
    log: bool
    top: float = 40.0
    bottom: float = 280.0

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Coordinates in the picture."""
        return (
            self.left + (self.right - self.left) * self._share(x, self.x),
            self.bottom - (self.bottom - self.top) * self._share(y, self.y),
        )

    def _share(self, value: float, limits: tuple[float, float]) -> float:
        low, high = limits
        if self.log:
            value, low, high = (math.log(max(v, low)) for v in (value, low, high))
        return (value - low) / (high - low)


def picture(rows: Sequence[Measured], touch_down: Mapping[str, tuple[Array, Array]]) -> str:
    """SVG with the force under one foot, and the error and chatter over the step.

    Args:
        rows: the study.
        touch_down: time [ms] and vertical force [N] around a touch-down, by label.
    """
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="sans-serif" font-size="12" role="img">',
            "<title>Step-size study of the foot contact</title>",
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
            *_forces(touch_down),
            *_errors(rows),
            "</svg>\n",
        ]
    )


def _forces(touch_down: Mapping[str, tuple[Array, Array]]) -> list[str]:
    peak = max(float(force.max()) for _, force in touch_down.values())
    axes = Axes(60, 410, (-5.0, 35.0), (0.0, 1.05 * peak), log=False)
    parts = _frame(axes, "time from touch-down [ms]", "vertical force on foot RF [N]")
    parts += _ticks(axes, [*range(0, 40, 10)], [*range(0, int(peak) + 1, 10)])
    for at, (label, (time, force)) in enumerate(touch_down.items()):
        points = list(zip(time.tolist(), force.tolist(), strict=True))
        parts += _line(axes, points, COLOURS[at], label, at)
    return parts


def _errors(rows: Sequence[Measured]) -> list[str]:
    axes = Axes(500, 840, (0.06, 2.2), (1e-4, 4.0), log=True)
    parts = _frame(axes, "step [ms]", "error, chatter [1]")
    parts += _ticks(axes, [0.1, 0.2, 0.5, 1.0, 2.0], [1e-4, 1e-3, 1e-2, 1e-1, 1.0])
    at = 0
    for depth in sorted({row.damping_depth_mm for row in rows}, reverse=True):
        law = [row for row in rows if row.damping_depth_mm == depth]
        label = f"damping depth {depth:g} mm"
        errors = [(row.step_ms, row.force_error) for row in law if row.force_error > 0.0]
        parts += _line(axes, errors, COLOURS[at], f"force error, {label}", at)
        shaking = [(row.step_ms, row.chatter) for row in law]
        parts += _line(axes, shaking, COLOURS[at + 1], f"chatter, {label}", at + 1)
        at += 2
    return parts


def _frame(axes: Axes, x: str, y: str) -> list[str]:
    middle = (axes.left + axes.right) / 2
    return [
        f'<rect x="{axes.left}" y="{axes.top}" width="{axes.right - axes.left}" '
        f'height="{axes.bottom - axes.top}" fill="none" stroke="#888888"/>',
        f'<text x="{middle}" y="{axes.bottom + 38}" text-anchor="middle">{x}</text>',
        f'<text x="{axes.left}" y="{axes.top - 12}">{y}</text>',
    ]


def _ticks(axes: Axes, x: Sequence[float], y: Sequence[float]) -> list[str]:
    parts = []
    for value in x:
        at, _ = axes.place(value, axes.y[0])
        parts.append(
            f'<text x="{at:.1f}" y="{axes.bottom + 16}" text-anchor="middle">{value:.3g}</text>'
        )
    for value in y:
        _, at = axes.place(axes.x[0], value)
        parts.append(
            f'<text x="{axes.left - 6}" y="{at + 4:.1f}" text-anchor="end">{value:.3g}</text>'
            f'<line x1="{axes.left}" x2="{axes.right}" y1="{at:.1f}" y2="{at:.1f}" '
            'stroke="#e4e4e4"/>'
        )
    return parts


def _line(
    axes: Axes, points: Sequence[tuple[float, float]], colour: str, label: str, at: int
) -> list[str]:
    # Errors grow to the right and forces fall: the legend goes where the lines are not.
    x, anchor = (axes.left + 12, "start") if axes.log else (axes.right - 12, "end")
    drawn = " ".join("{:.1f},{:.1f}".format(*axes.place(*point)) for point in points)
    return [
        f'<polyline points="{drawn}" fill="none" stroke="{colour}" stroke-width="1.5"/>',
        f'<text x="{x}" y="{axes.top + 18 + 16 * at}" fill="{colour}" text-anchor="{anchor}">'
        f"{label}</text>",
    ]
