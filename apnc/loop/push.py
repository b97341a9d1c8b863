"""Pushes: impulses from outside that a robot gets while it walks."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Final

from apnc.loop.schedule import first_tick
from apnc_plant.files import Number, checked, limits

LASTS: Final = 0.1
"""How long a push lasts [s], rounded to whole ticks."""


@checked(ValueError)
class Push:
    """An impulse that all bodies of a robot share by their mass, so that none moves on another.

    It acts in equal parts at the begin of every tick for ``LASTS``.

    Args:
        at: when it begins [s]; at the first tick from then on.
        x: impulse along x of the world, forward at the start [N s].
        y: impulse along y of the world, to the left at the start [N s].

    Raises:
        ValueError: a negative time, or a number that is not finite.
    """

    at: Annotated[Number, limits("s", ge=0.0)]
    x: Annotated[Number, limits("N.s")]
    y: Annotated[Number, limits("N.s")]

    def text(self) -> str:
        """The push as the command line takes it, e.g. ``3:0.2:-0.1``."""
        return ":".join(f"{value!r}".removesuffix(".0") for value in (self.at, self.x, self.y))


def parse_pushes(text: str) -> tuple[Push, ...]:
    """``"3:0.2:0,5:0:-0.1"``: begin [s], then the impulse along x and y [N s] of every push.

    Raises:
        ValueError: a text that is no such list.
    """
    pushes = []
    for part in text.split(","):
        try:
            at, x, y = map(float, part.split(":"))
        except ValueError:
            raise ValueError(
                f"push = '{text}' is not seconds:x:y, or several with commas between"
            ) from None
        pushes.append(Push(at, x, y))
    return tuple(pushes)


def pushes_text(pushes: Iterable[Push]) -> str:
    """The text that :func:`parse_pushes` reads, without rounding."""
    return ",".join(push.text() for push in pushes)


def velocity_changes(
    pushes: Iterable[Push], mass: float, Ts: float, ticks: int
) -> dict[int, tuple[float, float]]:
    """Change of the robot's velocity along x and y at the begin of ticks [m/s], by tick.

    Args:
        pushes: in any order.
        mass: total mass of the robot [kg].
        Ts: time of a tick [s].
        ticks: number of ticks of the run; what is later is left out.
    """
    lasts = max(1, round(LASTS / Ts))
    changes: dict[int, tuple[float, float]] = {}
    for push in pushes:
        if push.at >= ticks * Ts:
            continue
        first = first_tick(push.at, Ts)
        for n in range(first, min(first + lasts, ticks)):
            x, y = changes.get(n, (0.0, 0.0))
            changes[n] = x + push.x / (lasts * mass), y + push.y / (lasts * mass)
    return dict(sorted(changes.items()))
