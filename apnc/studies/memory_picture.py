"""S1 to S3 over time, with and without the neural couplings, as one SVG file (Fig. 10-12)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.loop.recording import Record
from apnc.report.theme import BAND, GREEN, GREY, GRID, INK, ORANGE, PURPLE, leg_colours
from apnc.studies.scenarios import Timeline
from apnc.studies.svg import line, path, rectangle, text, upright

Array = NDArray[np.float64]

WIDTH: Final = 900
HEIGHT: Final = 760
LEFT, RIGHT = 76, 14
BLOCK: Final = 350
"""Height of the panels of one run [px]."""
_EVERY: Final = 2
_PI: Final = ((0.0, "0"), (np.pi, "π"))


def memory_svg(with_anc: Record, without: Record, timeline: Timeline | None = None) -> str:
    """The picture: per run the outputs o1, the relative phases and the feet on the ground.

    Args:
        with_anc, without: two runs of ``run_scenario`` along the same timeline.
        timeline: that timeline.
    """
    when = timeline or Timeline()
    parts = _legend(with_anc.legs)
    for top, record, label in ((46, with_anc, "with ANC"), (46 + BLOCK, without, "without ANC")):
        parts += _states(when, top)
        parts.append(text(LEFT, top - 6, label, "start", weight="bold"))
        parts += _outputs(record, when, top)
        parts += _phases(record, when, top + 130)
        parts += _feet(record, when, top + 236)
    for second in range(0, round(when.end) + 1, 2):
        parts.append(text(_x(second, when), HEIGHT - 30, str(second)))
    parts.append(text(WIDTH / 2, HEIGHT - 10, "time [s]"))
    body = "\n".join(parts)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'font-family="system-ui, sans-serif" font-size="12" fill="{INK}">\n'
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>\n{body}\n</svg>\n'
    )


def _x(t: float, when: Timeline) -> float:
    return LEFT + (WIDTH - LEFT - RIGHT) * t / when.end


def _states(when: Timeline, top: float) -> list[str]:
    parts = []
    spans = (
        (0.0, when.lowered, "held"),
        (when.lowered, when.broken, "S1"),
        (when.broken, when.stopped, "S2: RF, LF stuck at 0.9"),
        (when.stopped, when.restarted, "MI = 0"),
        (when.restarted, when.end, "S3: no feedback"),
    )
    for n, (begin, end, label) in enumerate(spans):
        left, right = _x(begin, when), _x(end, when)
        if n % 2 == 0:
            parts.append(rectangle(left, top, right - left, BLOCK - 56, BAND))
        if label != "held":
            parts.append(text((left + right) / 2, top + 12, label))
    return parts


def _curve(record: Record, when: Timeline, values: Array, colour: str) -> str:
    """A curve through the y-values in px of every second sample."""
    return path(
        [
            (_x(float(t), when), float(y))
            for t, y in zip(record.time[::_EVERY], values, strict=True)
        ],
        colour,
    )


def _outputs(record: Record, when: Timeline, top: float) -> list[str]:
    parts = [upright(20, top + 66, "o1 [1]")]
    for leg, (name, colour) in enumerate(leg_colours(record.legs).items()):
        middle = top + 30 + 26.0 * leg
        parts.append(text(LEFT - 8, middle + 4, name, "end"))
        o1 = record.controller["o1"][::_EVERY, leg]
        parts.append(_curve(record, when, middle - 11.0 * o1, colour))
    return parts


def _phases(record: Record, when: Timeline, top: float) -> list[str]:
    def y(angle: Array) -> Array:
        return top + 84.0 - 84.0 * (angle + np.pi / 2.0) / (2.0 * np.pi)

    parts = [upright(20, top + 42, "phase [rad]")]
    for angle, label in _PI:
        at = float(y(np.array(angle)))
        parts.append(line(LEFT, at, WIDTH - RIGHT, at, GRID))
        parts.append(text(LEFT - 8, at + 4, label, "end"))
    o1, o2 = record.controller["o1"], record.controller["o2"]
    shown = metrics.wrap_for_display(metrics.relative_phases(o1, o2))
    stopped = (record.time >= when.stopped) & (record.time < when.restarted)
    shown[stopped] = np.nan  # four oscillators at rest have no phase
    shown = shown[::_EVERY]
    for k, colour in enumerate((ORANGE, GREEN, PURPLE)):
        # a jump is the cut of the display, not motion
        cut = np.abs(np.diff(shown[:, k], prepend=shown[0, k])) > np.pi
        parts.append(_curve(record, when, y(np.where(cut, np.nan, shown[:, k])), colour))
    return parts


def _feet(record: Record, when: Timeline, top: float) -> list[str]:
    parts = [upright(20, top + 26, "stance")]
    down = metrics.stance(record.plant["foot_force"][..., 2])
    for leg, (name, colour) in enumerate(leg_colours(record.legs).items()):
        row = top + 13.0 * leg
        parts.append(text(LEFT - 8, row + 9, name, "end"))
        change = np.flatnonzero(np.diff(down[:, leg].astype(int), prepend=0, append=0))
        times = np.append(record.time, when.end)
        for begin, end in zip(change[::2], change[1::2], strict=True):
            left, right = _x(float(times[begin]), when), _x(float(times[end]), when)
            parts.append(rectangle(left, row, right - left, 10, colour))
    return parts


def _legend(legs: Sequence[str]) -> list[str]:
    parts, x = [], WIDTH - 330.0
    for leg, colour in list(leg_colours(legs).items())[1:]:
        parts.append(line(x, 18, x + 18, 18, colour, 2.0))
        parts.append(text(x + 24, 22, f"phase {legs[0]}-{leg}", "start"))
        x += 105.0
    parts.append(line(LEFT, 30, WIDTH - RIGHT, 30, GREY, 0.5))
    return parts
