"""Pictures of a walk: the scene, the time with its unit, and which feet stand."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from apnc import metrics
from apnc.film.scene import Scene
from apnc.loop.record import Record
from apnc.report.look import LOOK, colours
from apnc.report.theme import VERMILLION
from apnc_core.types import Array

if TYPE_CHECKING:
    from PIL import Image, ImageDraw, ImageFont

FINE: Final = 2
"""Pictures are drawn larger by this factor and reduced, so that edges are smooth."""

SPAN: Final = 3.0
"""Time before and after the present one in the gait strip [s]."""

USUAL: Final = 640
"""Width at which lines and letters have the sizes of the page [px]; a wider picture enlarges them.
"""


class Pictures:
    """Draws a walk sample by sample.

    Args:
        record: the run, with at least one sample.
        width, height: of the pictures [px].

    Raises:
        ModuleNotFoundError: the extra ``video`` is not installed.
    """

    def __init__(self, record: Record, width: int, height: int) -> None:
        self._record, self._size = record, (width, height)
        self._unit = FINE * max(1.0, width / USUAL)
        self._row = 14.0 * self._unit
        self._strip = round(self._row * record.n_legs + 18.0 * self._unit)
        self._scene = Scene(record, FINE * width, FINE * height - self._strip)
        plant = record.signals
        yaw = plant["rpy"][:, 2]
        self._speed = metrics.smoothed_speed(record.time, plant["position"], yaw)
        self._colours = colours()

    @cached_property
    def _fonts(self) -> dict[int, ImageFont.FreeTypeFont | ImageFont.ImageFont]:
        from PIL import ImageFont  # noqa: PLC0415  # an extra

        return {size: ImageFont.load_default(size * self._unit) for size in (11, 13)}

    def draw(self, i: int) -> Image.Image:
        """The picture at a sample."""
        from PIL import Image, ImageDraw  # noqa: PLC0415  # an extra

        width, height = (FINE * edge for edge in self._size)
        image = Image.new("RGB", (width, height), self._colours["canvas"])
        brush = ImageDraw.Draw(image)
        self._ground(brush, i)
        self._past(brush, i)
        legs = self._scene.legs(i)
        parts: list[tuple[float, int]] = [(self._scene.depth(i), -1)]
        parts += [(float(chain[1, 2]), leg) for leg, chain in enumerate(legs)]
        for _, leg in sorted(parts):
            if leg < 0:
                self._box(brush, i)
            else:
                self._leg(brush, i, leg, legs[leg])
        for ends in self._scene.forces(i):
            self._arrow(brush, ends)
        self._words(brush, i)
        self._gait(brush, i)
        return image.reduce(FINE)

    def _line(self, brush: ImageDraw.ImageDraw, points: Array, colour: str, width: float) -> None:
        brush.line(_flat(points), colour, max(1, round(width * self._unit)), joint="curve")

    def _ground(self, brush: ImageDraw.ImageDraw, i: int) -> None:
        for (name, steps), width in zip(self._scene.floor(i).items(), (1.0, 1.4), strict=True):
            colour = self._colours["grid" if name == "ground" else "landmark"]
            thick = max(1, round(width * self._unit))
            for ends in steps[:, :, :2].reshape(-1, 4).tolist():
                brush.line(ends, colour, thick)

    def _past(self, brush: ImageDraw.ImageDraw, i: int) -> None:
        for x, y, _ in self._scene.track(i):
            self._dot(brush, x, y, 1.0, LOOK["track"])
        squeezed = max(0.2, float(np.sin(self._scene.elevation)))
        for (x, y, _), leg, fresh in self._scene.prints(i):
            colour = _mixed(self._scene.fixed["colours"][leg], self._colours["canvas"], fresh)
            rx, ry = 6.0 * self._unit, 6.0 * self._unit * squeezed
            brush.ellipse([x - rx, y - ry, x + rx, y + ry], colour)

    def _box(self, brush: ImageDraw.ImageDraw, i: int) -> None:
        corners, arrow = self._scene.box(i)
        for face, colour in LOOK["faces"]:
            seen = corners[face, :2]
            (ax, ay), (bx, by), (cx, cy) = seen[:3]
            if (bx - ax) * (cy - by) - (by - ay) * (cx - bx) < 0.0:
                brush.polygon(_flat(seen), colour)
                self._line(brush, np.concatenate([seen, seen[:2]]), LOOK["edge"], 1.0)
        for line in arrow:
            self._line(brush, line, LOOK["nose"], 2.0)

    def _leg(self, brush: ImageDraw.ImageDraw, i: int, leg: int, chain: Array) -> None:
        fixed, halo = self._scene.fixed, self._colours["canvas"]
        colour = fixed["colours"][leg]
        for width, shade in ((9.0, halo), (6.0, colour)):
            self._line(brush, chain, shade, width)
            for x, y, _ in chain[[0, -1]]:
                self._dot(brush, x, y, 0.5 * width, shade)
        for x, y, _ in chain[[1, 2]]:
            self._ring(brush, x, y, 4.0 * self._unit, halo, colour)
        x, y, _ = chain[3]
        stands = bool(self._scene.standing[i, leg])
        self._ring(brush, x, y, 0.9 * self._scene.radius, colour if stands else halo, colour)
        below = y + self._scene.radius + 3.0 * self._unit
        brush.text(
            (x, below), fixed["legs"][leg], self._colours["ink"], self._fonts[11], anchor="ma"
        )

    def _dot(
        self, brush: ImageDraw.ImageDraw, x: float, y: float, radius: float, colour: str
    ) -> None:
        r = radius * self._unit
        brush.ellipse([x - r, y - r, x + r, y + r], colour)

    def _ring(
        self, brush: ImageDraw.ImageDraw, x: float, y: float, r: float, fill: str, edge: str
    ) -> None:
        r += self._unit
        brush.ellipse([x - r, y - r, x + r, y + r], fill, edge, round(2.0 * self._unit))

    def _arrow(self, brush: ImageDraw.ImageDraw, ends: Array) -> None:
        (x0, y0), (x1, y1) = ends[:, :2]
        self._line(brush, ends, self._colours["ink"], 2.2)
        length = float(np.hypot(x1 - x0, y1 - y0))
        if length < 8.0 * self._unit:
            return
        u = np.array([x1 - x0, y1 - y0]) / length * self._unit
        v, tip = np.array([-u[1], u[0]]), np.array([x1, y1])
        head = np.array([tip + 5.0 * u, tip - 5.0 * u + 4.0 * v, tip - 5.0 * u - 4.0 * v])
        brush.polygon(_flat(head), self._colours["ink"])

    def _words(self, brush: ImageDraw.ImageDraw, i: int) -> None:
        speed = self._speed[i]
        known = f"   {speed:.2f} m/s" if np.isfinite(speed) else ""
        text = f"{self._record.robot.name}   {self._record.time[i]:.2f} s{known}"
        place = (10.0 * self._unit, 8.0 * self._unit)
        brush.text(place, text, self._colours["ink"], self._fonts[13])
        scale = "strong lines: 0.5 m"
        width = FINE * self._size[0]
        brush.text(
            (width - place[0], FINE * self._size[1] - self._strip - 4.0 * self._unit),
            scale, self._colours["soft"], self._fonts[11], anchor="rd",
        )  # fmt: skip

    def _gait(self, brush: ImageDraw.ImageDraw, i: int) -> None:
        width, height = (FINE * edge for edge in self._size)
        top, left = height - self._strip, 34.0 * self._unit
        time, now = self._record.time, self._record.time[i]
        brush.rectangle([0, top, width, height], self._colours["card"])

        def x(t: Array) -> Array:
            places: Array = left + (t - now + SPAN) / (2.0 * SPAN) * (width - left)
            return np.maximum(left, places)

        first, end = np.searchsorted(time, [now - SPAN, now + SPAN])
        edges = x(np.append(time[first:end], time[end - 1] + self._record.experiment.Ts))
        for leg, (name, colour) in enumerate(
            zip(self._scene.fixed["legs"], self._scene.fixed["colours"], strict=True)
        ):
            y = top + leg * self._row + 4.0 * self._unit
            bar = y + self._row - 3.0 * self._unit
            brush.rectangle([left, y, width, bar], self._colours["swing"])
            for begin, stop in _runs(self._scene.standing[first:end, leg]):
                brush.rectangle([edges[begin], y, edges[stop], bar], self._colours["stance"])
            middle = (8.0 * self._unit, 0.5 * (y + bar))
            brush.text(middle, name, colour, self._fonts[11], anchor="lm")
        bottom = top + self._record.n_legs * self._row + 4.0 * self._unit
        for second in range(int(np.ceil(max(0.0, now - SPAN))), int(now + SPAN) + 1):
            at = float(x(np.array(second)))
            if left + 10 * self._unit < at < width - 14 * self._unit and second <= time[-1]:
                place = (at, bottom)
                brush.text(
                    place, f"{second} s", self._colours["soft"], self._fonts[11], anchor="ma"
                )
        at = float(x(np.array(now)))
        brush.rectangle([at - self._unit, top + 2, at + self._unit, bottom], VERMILLION)


def _flat(points: Array) -> list[float]:
    flat: list[float] = points[:, :2].ravel().tolist()
    return flat


def _runs(flags: Any) -> Sequence[tuple[int, int]]:
    """Begin and end of every run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(np.int8), [0]])))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]


def _mixed(colour: str, ground: str, fresh: float) -> str:
    """A colour over another, as opaque as a footprint of that age in the page."""
    share = 0.55 * fresh
    parts = [
        round(share * int(colour[k : k + 2], 16) + (1.0 - share) * int(ground[k : k + 2], 16))
        for k in (1, 3, 5)
    ]
    return "#" + "".join(f"{part:02x}" for part in parts)
