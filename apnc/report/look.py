"""How the robot is drawn: numbers and colours for the page and for films."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any, Final

LOOK: Final[dict[str, Any]] = {
    # azimuth and elevation of the camera [rad], relative to the robot's heading
    "views": {
        "3d": [-0.95, 0.42],
        "side": [-math.pi / 2.0, 0.0],
        "top": [-math.pi / 2.0, math.pi / 2.0],
        "front": [0.0, 0.0],
    },
    # corners of the trunk are numbered 4 y + 2 x + z, 0 for the lower end of each edge; a colour
    "faces": [
        [[2, 6, 7, 3], "#a9b6c4"],
        [[4, 0, 1, 5], "#a9b6c4"],
        [[0, 2, 3, 1], "#c0cad5"],
        [[6, 4, 5, 7], "#c0cad5"],
        [[1, 3, 7, 5], "#dde4ec"],
        [[4, 6, 2, 0], "#8f9dac"],
    ],
    "edge": "#5b6673",
    # the arrow on the trunk, along its length and width, and its colour
    "arrow": [[[0.25, 0.5], [0.85, 0.5]], [[0.72, 0.35], [0.85, 0.5], [0.72, 0.65]]],
    "nose": "#33404d",
    "track": "#8a94a0",
    # reach of the ground over the smaller side of the canvas; middle of the robot from above
    "zoom": 2.7,
    "middle": 0.45,
    # drawn footprints are younger than this [samples]; points of the track, and their distance
    "prints": 600,
    "tracked": 900,
    "trackStep": 6,
    # length of the arrow of a force as heavy as the robot [m], and the least one drawn
    "force": 0.2,
    "leastForce": 0.02,
}


@cache
def colours() -> dict[str, str]:
    """Colours of a light page by name, as its style sheet has them, e.g. ``grid``."""
    css = (Path(__file__).parent / "templates" / "style.css").read_text(encoding="utf-8")
    light = re.search(r":root \{(.*?)\}", css, re.DOTALL)
    assert light is not None
    return {
        name: text if len(text) == 7 else "#" + "".join(2 * digit for digit in text[1:])
        for name, text in re.findall(r"--([\w-]+): (#\w+)", light[1])
    }
