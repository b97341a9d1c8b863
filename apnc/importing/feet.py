"""Where the foot of a leg is."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

import numpy as np

from apnc.importing.limbs import Segment
from apnc.importing.model import ModelFileError, Shape
from apnc_core.types import Array

_FOOT: Final = re.compile(r"foot|toe|sole|contact|(?<![a-z])(?:ee|tip|end)(?![a-z])", re.IGNORECASE)
"""Names of frames that mark a foot."""


@dataclass(frozen=True)
class Foot:
    """A foot in the frame of the last segment.

    Args:
        name: of the shape or frame in the file.
        center: of the ball [m], shape (3,).
        radius: of the ball [m]; None if the file has only a frame.
    """

    name: str
    center: Array
    radius: float | None


def foot_of(leg: tuple[Segment, ...]) -> Foot:
    """The foot of a leg: a ball, else the end of a capsule, else a frame with such a name.

    What touches goes before what is only seen, and what is farther from the knee before the rest.
    """
    last = leg[-1]
    marks = [(name, frame.position) for name, frame in last.frames.items() if _FOOT.search(name)]
    far = max((float(np.linalg.norm(point)) for _, point in marks), default=0.0)
    for touching in (True, False):
        balls = [
            Foot(shape.name, center, radius)
            for shape in last.shapes
            if shape.touches is touching
            for center, radius in _ends(shape)
        ]
        best = max(balls, key=lambda ball: float(np.linalg.norm(ball.center)), default=None)
        if best is not None:
            reach = float(np.linalg.norm(best.center)) + 2.0 * (best.radius or 0.0)
            if reach >= far:
                return best
    if marks:
        name, point = max(marks, key=lambda mark: float(np.linalg.norm(mark[1])))
        return Foot(name, point, None)
    frames = [(name, frame.position) for name, frame in last.frames.items()]
    name, point = max(frames, key=lambda mark: float(np.linalg.norm(mark[1])))
    if np.linalg.norm(point) > 1e-3:
        return Foot(name, point, None)
    raise ModelFileError(
        f"leg {leg[0].name}: {last.name} ends without a foot; allowed: a sphere or capsule, or a "
        "frame that is fixed to it"
    )


def _ends(shape: Shape) -> list[tuple[Array, float]]:
    """Balls at the ends of a shape, with their radii [m]."""
    center, half = shape.frame.position, shape.half
    if shape.kind == "sphere":
        return [(center, float(half[0]))]
    if shape.kind == "capsule":
        reach = shape.frame.turn @ np.array([0.0, 0.0, half[2] - half[0]])
        return [(center - reach, float(half[0])), (center + reach, float(half[0]))]
    return []
