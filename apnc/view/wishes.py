"""What a page may ask for: a push, another speed, a pause."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any, Final

HARDEST: Final = 2.0
"""Largest push of the page, as the change of the robot's velocity [m/s]."""

SPEEDS: Final = (0.01, 100.0)
"""Least and largest speed that a page may ask for, besides as fast as it goes."""


@dataclass(frozen=True)
class Wish:
    """One of three wishes; the others are None.

    Args:
        push: impulse along x and y of the world [N s].
        speed: simulated time per time of the clock; infinity: as fast as it goes.
        pause: whether the walk stands still.
    """

    push: tuple[float, float] | None = None
    speed: float | None = None
    pause: bool | None = None


def wish_of(message: str | bytes, mass: float) -> Wish:
    """The wish in a message, e.g. ``{"push": [0.2, -0.4]}``, ``{"speed": null}``.

    Args:
        message: text of the page; a speed of null is as fast as it goes.
        mass: of the robot [kg], which limits a push.

    Raises:
        ValueError: it is no wish, or one beyond its limits.
    """
    try:
        content: Any = json.loads(message)
        ((name, value),) = content.items()
    except (ValueError, AttributeError, RecursionError):
        raise ValueError("not a wish") from None
    if name == "pause" and isinstance(value, bool):
        return Wish(pause=value)
    if name == "speed" and (value is None or _number(value)):
        if value is not None and not SPEEDS[0] <= value <= SPEEDS[1]:
            raise ValueError(f"speed is {value}; allowed: {SPEEDS[0]} to {SPEEDS[1]}")
        return Wish(speed=math.inf if value is None else float(value))
    if name == "push" and isinstance(value, list) and len(value) == 2 and all(map(_number, value)):
        x, y = float(value[0]), float(value[1])
        if math.hypot(x, y) > HARDEST * mass:
            raise ValueError(f"push is too hard; allowed: {HARDEST * mass:g} N s")
        return Wish(push=(x, y))
    raise ValueError("not a wish")


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
