"""Films and picture sheets of how the feet move: ``film-mi-*.gif`` and ``feet-mi-*.png``.

python -m research.docs.film docs/pictures              # MI 0.04, 0.08, 0.15, 0.28 and 0.4
python -m research.docs.film docs/pictures 0.1 0.2      # others
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Final

import numpy as np
from PIL import Image, ImageColor, ImageDraw, ImageFont
from scipy.interpolate import CubicSpline
from scipy.spatial import ConvexHull

from apnc import metrics
from apnc.features import WalkFeatures, walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.loop.simulate import simulate
from apnc.report import theme
from apnc.report.skeleton import clearance, leg_chains, trunk_corners
from apnc_core.types import Array
from research.docs import DOCS
from research.docs.manifest import USUAL, note

PICTURES: Final = DOCS / "pictures"

Box = tuple[float, float, float, float]
"""Left, top, width and height [px]."""

MI: Final = (0.04, 0.08, 0.15, 0.28, 0.4)
DURATION: Final = 30.0
STEADY: Final = 12.0
"""From here on [s] the walk counts as steady; everything shown and told is from then on."""

SLOWER: Final = 4.0
RATE: Final = 25.0
"""Pictures of the film per second."""
FILMED: Final = 1.6
"""Least time that a film shows [s]; it ends with a whole stride."""

FINE: Final = 2
"""Everything is drawn so many times as large and then made smaller, for smooth edges."""
MARGIN: Final = 12.0
TICK: Final = 50.0
"""Marks of the ground [mm]."""
HIGHEST: Final = 21.0
"""Top of the panels of the feet [mm]."""
GRID: Final = (0.0, 5.0, 10.0, 15.0, 20.0)
FAR: Final = 0.6
STANDS: Final = 0.45
"""How much of the colour of a leg on the far side, and of a foot that stands, is white."""
TRUNK: Final = "#eef1f4"
KEY: Final = "filled: foot stands; arrow: its load"
ARROW: Final = 26.0
"""Length of the arrow of a load of half the weight [mm]."""


def lighter(colour: str, white: float) -> str:
    """A colour mixed with a share of white."""
    mixed = (round(c + white * (255 - c)) for c in ImageColor.getrgb(colour))
    return "#{:02x}{:02x}{:02x}".format(*mixed)


class View:
    """A steady walk from its right side, in a frame that follows the smoothed place and heading.

    Attributes:
        way: of the frame along the path [mm], (T,).
        chains: points of every leg, forward and up [mm], (T, n, 4, 2).
        trunk: corners of the trunk likewise, (T, 8, 2).
        lows: lowest point of every foot, forward, and up over the ground [mm], (T, n, 2).
        loads: of the ground on every foot, halves of the weight [1], (T, n).
    """

    def __init__(self, record: Record) -> None:
        plant, self.record = record.signals, record
        place, yaw = (metrics.smooth(v) for v in (plant["position"], np.unwrap(plant["rpy"][:, 2])))
        ahead = np.stack([np.cos(yaw), np.sin(yaw)], axis=-1)

        def seen(points: Array) -> Array:
            flat = points.reshape(len(points), -1, 3)
            forward = np.einsum("tki,ti->tk", flat[..., :2] - place[:, None, :2], ahead)
            found = 1000.0 * np.stack([forward, flat[..., 2]], axis=-1)
            return found.reshape(*points.shape[:-1], 2)

        steps = np.linalg.norm(np.diff(place[:, :2], axis=0), axis=1)
        self.way = 1000.0 * np.append(0.0, np.cumsum(steps))
        self.chains = seen(leg_chains(record.robot, plant))
        self.trunk = seen(trunk_corners(record.robot, plant))
        feet, ground = plant["foot_position"], record.experiment.ground
        self.lows = np.stack(
            [self.chains[:, :, -1, 0], 1000.0 * clearance(ground, record.robot, feet)], axis=-1
        )
        self.loads = plant["foot_force"][..., 2] * 2.0 / (record.mass * metrics.GRAVITY)
        self.standing = metrics.stance(plant["foot_force"][..., 2])
        c = record.signals
        self.starts = metrics.cycle_starts(c["o1"], c["o2"])

    def at(self, sample: float) -> Moment:
        """What is seen between two samples."""
        return Moment(self, sample)

    @cached_property
    def splines(self) -> dict[str, CubicSpline]:
        """What moves smoothly, over the samples."""
        along = np.arange(len(self.way))
        names = ("way", "chains", "trunk", "lows")
        return {name: CubicSpline(along, getattr(self, name)) for name in names}

    @cached_property
    def colours(self) -> list[str]:
        """Of the legs; lighter on the far side."""
        near, own = self.record.n_legs // 2, theme.leg_colours(self.record.legs).values()
        return [lighter(colour, FAR * (i >= near)) for i, colour in enumerate(own)]

    @property
    def reach(self) -> float:
        """Half of the width to be shown [mm]."""
        return float(np.abs(self.chains[..., 0]).max()) + 25.0

    @property
    def height(self) -> float:
        """Height to be shown over the ground [mm]."""
        return float(max(self.trunk[..., 1].max(), self.chains[..., 1].max())) + 15.0


class Moment:
    """A view at one instant."""

    def __init__(self, view: View, sample: float) -> None:
        self.sample, before = sample, int(sample)
        self.way, self.chains, self.trunk, self.lows = (s(sample) for s in view.splines.values())
        self.standing, self.loads = view.standing[before], view.loads[before]


class Canvas:
    """A white picture, drawn in its own pixels."""

    def __init__(self, width: float, height: float) -> None:
        self.image = Image.new("RGB", (round(FINE * width), round(FINE * height)), "white")
        self._draw = ImageDraw.Draw(self.image)

    def line(self, points: Array | Sequence[Sequence[float]], colour: str, width: float) -> None:
        """A line through points (k, 2)."""
        flat = [(FINE * x, FINE * y) for x, y in points]
        self._draw.line(flat, fill=colour, width=round(FINE * width), joint="curve")

    def area(self, points: Array, colour: str, edge: str) -> None:
        """A filled polygon."""
        flat = [(FINE * x, FINE * y) for x, y in points]
        self._draw.polygon(flat, fill=colour, outline=edge, width=FINE)

    def disc(self, centre: Array, radius: float, fill: str, edge: str) -> None:
        """A disc with an edge."""
        (x, y), r = FINE * np.asarray(centre), FINE * radius
        self._draw.ellipse((x - r, y - r, x + r, y + r), fill=fill, outline=edge, width=2 * FINE)

    def text(self, x: float, y: float, text: str, size: float = 12.0, anchor: str = "ls") -> None:
        """Words from (x, y) on, or as the anchor says."""
        font = ImageFont.load_default(FINE * size)
        self._draw.text((FINE * x, FINE * y), text, fill=theme.INK, font=font, anchor=anchor)

    def done(self) -> Image.Image:
        """The picture."""
        return self.image.reduce(FINE)


def draw_robot(canvas: Canvas, view: View, moment: Moment, box: Box) -> None:
    """The robot in side view on its ground, with trails of the last stride and loads."""
    left, top, width, height = box
    scale = min(width / (2 * view.reach), height / (view.height + ARROW + 8.0))
    floor = top + scale * view.height

    def place(points: Array) -> Array:
        return np.array([left + width / 2, floor]) + scale * points * [1.0, -1.0]

    canvas.line([(left, floor), (left + width, floor)], theme.GREY, 1.0)
    begin = np.ceil((moment.way - view.reach) / TICK) * TICK
    for x in np.arange(begin, moment.way + view.reach, TICK) - moment.way:
        tick = place(np.array([[x, 0.0], [x, -5.0]]))
        if left <= tick[0, 0] <= left + width:
            canvas.line(tick, theme.GREY, 1.0)
    legs = range(view.record.n_legs)
    near = view.record.n_legs // 2
    radius = 1000.0 * view.record.robot.contact.foot_radius
    middle = float(moment.trunk[:, 1].mean())
    for leg in legs:
        mount = moment.chains[leg, 0]
        canvas.line(place(np.array([mount, [mount[0], middle]])), theme.GRID, 5.0)
    for leg in [*legs[near:], None, *legs[:near]]:
        if leg is None:
            hull = moment.trunk[ConvexHull(moment.trunk).vertices]
            canvas.area(place(hull), TRUNK, theme.GREY)
            continue
        colour, chain = view.colours[leg], moment.chains[leg]
        canvas.line(place(chain), colour, 5.0 if leg < near else 4.0)
        for joint in place(chain[1:-1]):
            canvas.disc(joint, 3.5, "white", colour)
        fill = lighter(colour, STANDS) if moment.standing[leg] else "white"
        canvas.disc(place(chain[-1]), scale * radius, fill, colour)
        trail = view.splines["chains"](_last_stride(view, leg, moment.sample))[:, leg, -1]
        canvas.line(place(trail), colour, 1.5)
        length = ARROW * min(float(moment.loads[leg]), 1.5)
        if length > 2.0:
            arrow = np.array([[0, -length], [0, -1], [-3, -6], [0, -1], [3, -6]])
            canvas.line(place(arrow + np.array([chain[-1, 0], 0.0])), colour, 2.0)


def _last_stride(view: View, leg: int, sample: float) -> Array:
    """Samples, with fractions, of the stride of a leg that ends now."""
    period = float(np.median(np.diff(view.starts[leg])))
    return np.linspace(max(sample - period, 0.0), sample, 60)


def draw_feet(
    canvas: Canvas, view: View, feet: WalkFeatures, box: Box, moment: Moment | None = None
) -> None:
    """A panel per foot: its lowest point over the ground, all strides, heights stretched."""
    left, top, width, height = box
    n, reach = view.record.n_legs, max(float(np.ptp(view.lows[..., 0], axis=0).max()) / 2, 1.0) + 6
    own = width / n
    up, along = (height - 50.0) / HIGHEST, (own - 40.0) / (2 * reach)
    floor = top + height - 28.0
    for leg, name in enumerate(view.record.legs):
        x0 = left + own * leg + 24.0
        middle = x0 + along * reach
        centre = float(np.ptp(view.lows[:, leg, 0]) / 2 + view.lows[:, leg, 0].min())

        def place(points: Array, middle: float = middle, centre: float = centre) -> Array:
            return np.array([middle, floor]) + (points - [centre, 0.0]) * [along, -up]

        for level in GRID:
            y = floor - up * level
            shade = theme.GREY if level == 0.0 else theme.GRID
            canvas.line([(x0, y), (x0 + 2 * along * reach, y)], shade, 1.0)
            canvas.text(x0 - 4.0, y, f"{level:.0f}", 9.0, "rm")
        colour = theme.leg_colours(view.record.legs)[name]
        for a, b in zip(view.starts[leg][:-1], view.starts[leg][1:], strict=True):
            stride = view.splines["lows"](np.linspace(a, b, 60))[:, leg]
            canvas.line(place(stride), lighter(colour, 0.75), 0.5)
        last = len(view.lows) - 1 if moment is None else moment.sample
        trail = view.splines["lows"](_last_stride(view, leg, last))[:, leg]
        canvas.line(place(trail), colour, 2.0)
        if moment is not None:
            fill = lighter(colour, STANDS) if moment.standing[leg] else "white"
            canvas.disc(place(moment.lows[leg]), 4.0, fill, colour)
        lift = feet.foot_lift_mm[name]
        words = "no lift" if lift is None else f"{name} lift {lift:.1f} mm"
        canvas.text(x0, top + 14.0, words, 12.0)
    bar = np.array([[left + 24.0, floor + 22.0], [left + 24.0 + along * 20.0, floor + 22.0]])
    canvas.line(bar, theme.INK, 1.5)
    canvas.text(bar[1, 0] + 5, floor + 25, f"20 mm; heights x {up / along:.1f}", 9.0)


def heading(view: View, feet: WalkFeatures) -> str:
    """What is seen."""
    speed, stride = feet.path_speed_m_per_s or 0.0, feet.stride_frequency_hz or 0.0
    return (
        f"MI {view.record.experiment.mi:g}: {speed:.3f} m/s, {stride:.2f} strides/s, "
        f"{feet.gait or 'no known gait'}"
    )


def with_few_colours(view: View, picture: Image.Image) -> Image.Image:
    """The picture in the colours that were drawn with, and four steps from each to white."""
    own = [*theme.leg_colours(view.record.legs).values(), theme.INK, theme.GREY, theme.GRID, TRUNK]
    shades = {lighter(colour, step / 5) for colour in own for step in range(6)}
    palette = Image.new("P", (1, 1))
    palette.putpalette([c for shade in sorted(shades) for c in ImageColor.getrgb(shade)])
    return picture.quantize(palette=palette, dither=Image.Dither.NONE)


def film(view: View, feet: WalkFeatures, file: Path) -> None:
    """A GIF at a quarter of the speed, of whole strides of the first leg."""
    starts, rate = view.starts[0], view.record.experiment.rate
    count = min(int(np.ceil(FILMED * (feet.stride_frequency_hz or 1.0))) + 1, len(starts) - 1)
    begin, end = starts[1], starts[count]
    step = rate / RATE / SLOWER
    pictures = []
    for sample in np.arange(begin, end - step / 2, step):
        canvas, moment = Canvas(640, 440), view.at(float(sample))
        canvas.text(MARGIN, 22, heading(view, feet), 15.0)
        canvas.text(640 - MARGIN, 22, f"1/{SLOWER:g} of the speed; {KEY}", 11.0, "rs")
        draw_robot(canvas, view, moment, (MARGIN, 32, 640 - 2 * MARGIN, 266))
        draw_feet(canvas, view, feet, (MARGIN, 302, 640 - 2 * MARGIN, 132), moment)
        pictures.append(canvas.done())
    indexed = [with_few_colours(view, picture) for picture in pictures]
    indexed[0].save(
        file, save_all=True, append_images=indexed[1:], duration=round(1000 / RATE), loop=0
    )


def sheet(view: View, feet: WalkFeatures, file: Path, count: int = 8) -> None:
    """A PNG: a stride of the first leg in pictures, and every foot with its figures."""
    width, cell, high = 1200.0, 294.0, 196.0
    canvas = Canvas(width, 2 * high + 340)
    canvas.text(MARGIN, 26, heading(view, feet), 18.0)
    canvas.text(width - MARGIN, 26, f"a stride of {view.record.legs[0]}; {KEY}", 12.0, "rs")
    begin, end = view.starts[0][1:3]
    for k, sample in enumerate(np.linspace(begin, end, count, endpoint=False)):
        x, y = MARGIN + (k % 4) * cell, 40 + (k // 4) * high
        moment = view.at(float(sample))
        draw_robot(canvas, view, moment, (x, y, cell - 10, high - 14))
        canvas.text(x, y + 12, f"{k}/{count}", 11.0)
    top = 2 * high + 50
    draw_feet(canvas, view, feet, (MARGIN, top, width - 2 * MARGIN, 220))
    own = (width - 2 * MARGIN) / view.record.n_legs
    for leg, name in enumerate(view.record.legs):
        slip, share = feet.slip_per_stride_mm[name], feet.slip_share[name]
        touches, duty = feet.touch_downs_by_leg[name], feet.duty_factor[name]
        lines = (
            f"slip {_told(slip, 1)} mm = {_told(share and 100 * share, 0)} % of the stride",
            f"touch-downs per stride {_told(touches, 2)}, duty {_told(duty, 2)}",
        )
        for row, words in enumerate(lines):
            canvas.text(MARGIN + own * leg + 24, top + 240 + 18 * row, words, 12.0)
    with_few_colours(view, canvas.done()).save(file, optimize=True)


def _told(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f}"


def steady_part(record: Record) -> Record:
    """The walk from ``STEADY`` on."""
    begin = int(np.searchsorted(record.time, STEADY))
    return record[begin:]


def main(folder: Path, mis: Sequence[float]) -> None:
    """Walk with every MI and write its film and its sheet."""
    folder.mkdir(parents=True, exist_ok=True)
    for mi in mis:
        record = simulate(Experiment(mi=mi, duration=DURATION))
        part = steady_part(record)
        if not len(part) or min(map(len, (view := View(part)).starts)) < 4:
            sys.exit(f"MI {mi:g}: {record.end} at {record.ended_at:g} s without three strides")
        feet = walk_features(part)
        files = [folder / f"film-mi-{mi:g}.gif", folder / f"feet-mi-{mi:g}.png"]
        film(view, feet, files[0])
        sheet(view, feet, files[1])
        if folder.resolve() == PICTURES:
            note({USUAL}, *files)


if __name__ == "__main__":
    main(Path(sys.argv[1]), [float(mi) for mi in sys.argv[2:]] or MI)
