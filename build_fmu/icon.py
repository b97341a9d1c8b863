"""model.png: the FMU's icon, drawn anew by each build with nothing but arithmetic."""

from __future__ import annotations

import itertools
import struct
import zlib
from typing import Final

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float64]
Colour = tuple[int, int, int]
Point = tuple[float, float]

SIZE: Final = 256
_SCALE: Final = SIZE / 100  # drawn on a square of 100 by 100, y down
_NAVY: Final = (24, 42, 66)
_WHITE: Final = (245, 248, 252)
_BLUE: Final = (79, 157, 222)
_ORANGE: Final = (245, 158, 54)
_GROUND: Final = (72, 94, 124)


def _grid() -> tuple[Image, Image]:
    centre = (np.arange(SIZE) + 0.5) / _SCALE
    return np.meshgrid(centre, centre)


def _distance_to_line(a: Point, b: Point) -> Image:
    """Distance of every pixel from the line between two points."""
    x, y = _grid()
    along = (b[0] - a[0], b[1] - a[1])
    length = along[0] ** 2 + along[1] ** 2
    t = np.clip(((x - a[0]) * along[0] + (y - a[1]) * along[1]) / length, 0.0, 1.0)
    distance: Image = np.sqrt((x - a[0] - t * along[0]) ** 2 + (y - a[1] - t * along[1]) ** 2)
    return distance


def _distance_to_box(low: Point, high: Point, radius: float) -> Image:
    """Signed distance from a box with round corners."""
    x, y = _grid()
    dx = np.abs(x - (low[0] + high[0]) / 2) - (high[0] - low[0]) / 2 + radius
    dy = np.abs(y - (low[1] + high[1]) / 2) - (high[1] - low[1]) / 2 + radius
    outside: Image = np.sqrt(np.maximum(dx, 0.0) ** 2 + np.maximum(dy, 0.0) ** 2)
    inside: Image = np.minimum(np.maximum(dx, dy), 0.0)
    return outside + inside - radius


def _distance_to_point(centre: Point) -> Image:
    x, y = _grid()
    return np.sqrt((x - centre[0]) ** 2 + (y - centre[1]) ** 2)


def _cover(distance: Image) -> Image:
    """Share of each pixel that lies inside, for edges without steps."""
    return np.clip(0.5 - distance * _SCALE, 0.0, 1.0)


class _Canvas:
    def __init__(self) -> None:
        self.colour = np.zeros((SIZE, SIZE, 3))
        self.alpha = np.zeros((SIZE, SIZE))

    def paint(self, distance: Image, colour: Colour) -> None:
        cover = _cover(distance)[:, :, None]
        self.colour = self.colour * (1.0 - cover) + np.array(colour, dtype=float) * cover
        self.alpha = np.maximum(self.alpha, cover[:, :, 0])

    def stroke(self, points: list[Point], width: float, colour: Colour) -> None:
        lines = [_distance_to_line(a, b) - width / 2 for a, b in itertools.pairwise(points)]
        self.paint(np.minimum.reduce(lines), colour)

    def dot(self, centre: Point, radius: float, colour: Colour) -> None:
        self.paint(_distance_to_point(centre) - radius, colour)

    def leg(self, points: list[Point], colour: Colour) -> None:
        self.stroke(points, 5.5, colour)
        self.dot(points[-1], 3.8, colour)
        self.dot(points[0], 2.0, _NAVY)


def _wave(left: float, right: float, middle: float, height: float) -> list[Point]:
    """One and a half periods of a wave, from parabolas: they round alike on every machine."""
    points = []
    for i in range(49):
        u = 3.0 * i / 48
        arch = int(min(u, 2.999))
        v = u - arch
        points.append(
            (left + (right - left) * i / 48, middle - (-1) ** arch * height * 4 * v * (1 - v))
        )
    return points


def _draw() -> _Canvas:
    canvas = _Canvas()
    canvas.paint(_distance_to_box((2, 2), (98, 98), 18), _NAVY)
    canvas.stroke([(14, 83), (86, 83)], 2.5, _GROUND)
    # a trot: the legs of one diagonal carry the load, the other two swing
    hind_down: list[Point] = [(27, 50), (21, 65), (27, 80)]
    hind_up: list[Point] = [(33, 50), (30, 63), (40, 71)]
    front_down: list[Point] = [(65, 50), (60, 65), (66, 80)]
    front_up: list[Point] = [(74, 50), (71, 63), (81, 71)]
    canvas.leg(hind_up, _BLUE)
    canvas.leg(front_down, _ORANGE)
    canvas.paint(_distance_to_box((19, 38), (83, 54), 6), _WHITE)
    canvas.leg(hind_down, _ORANGE)
    canvas.leg(front_up, _BLUE)
    canvas.dot((78, 43), 2, _NAVY)
    # the rhythm that the feet shape
    canvas.stroke(_wave(20, 80, 22, 8), 3.4, _BLUE)
    canvas.dot((30, 14), 3.8, _ORANGE)
    return canvas


def _chunk(kind: bytes, content: bytes) -> bytes:
    checksum = zlib.crc32(kind + content)
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)


def icon_png() -> bytes:
    """The icon as a PNG file with transparency, ``SIZE`` pixels wide and high."""
    canvas = _draw()
    pixels = np.dstack([canvas.colour, canvas.alpha * 255.0])
    lines = np.rint(pixels).astype(np.uint8).reshape(SIZE, SIZE * 4)
    plain = b"".join(b"\0" + line.tobytes() for line in lines)
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 6, 0, 0, 0)
    body = _chunk(b"IHDR", header) + _chunk(b"IDAT", zlib.compress(plain, 9)) + _chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body
