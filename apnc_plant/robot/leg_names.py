"""Names of legs: a robot's own, those by place, and those that other robots use."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

ALIASES: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        "right front": ("RF", "FR", "front right"),
        "right middle": ("RM", "MR", "middle right"),
        "right hind": ("RH", "HR", "RR", "hind right", "right rear", "rear right"),
        "left front": ("LF", "FL", "front left"),
        "left middle": ("LM", "ML", "middle left"),
        "left hind": ("LH", "HL", "RL", "hind left", "left rear", "rear left"),
    }
)
"""Names of a leg by its place. R is right before a place and rear before a side, as in RR."""


def by_place(legs: tuple[str, ...]) -> dict[str, str]:
    """The robot's own name of the leg at each place that it has.

    Args:
        legs: names of a robot's legs in the order of the controller: the first n // 2 are right
            legs, from front to hind. The only leg of a side is its front and its hind leg.
    """
    half, found = len(legs) // 2, {}
    for side, names in (("right", legs[:half]), ("left", legs[half:])):
        if names:
            found[f"{side} front"] = names[0]
        if len(names) == 3:
            found[f"{side} middle"] = names[1]
        if names:
            found[f"{side} hind"] = names[-1]
    return found


def leg_named(name: str, legs: tuple[str, ...]) -> str:
    """The robot's own name of a leg.

    Args:
        name: a name of the robot's own, or one of ``ALIASES`` in small or capital letters, with
            spaces, ``_`` or ``-`` between words. A name of the robot's own goes first.
        legs: as in :func:`by_place`.

    Raises:
        ValueError: the robot has no such leg.
    """
    if name in legs:
        return name
    wanted, places = _plain(name), by_place(legs)
    for place, leg in places.items():
        if wanted in map(_plain, (place, *ALIASES[place])):
            return leg
    others = "; ".join(f"{place}, {', '.join(ALIASES[place])}" for place in places)
    raise ValueError(f"leg {name!r} is not one of {', '.join(legs)}; nor {others}")


def same_legs(others: tuple[str, ...], legs: tuple[str, ...]) -> bool:
    """Whether names are those of a robot's legs, in its order, by their own names or by aliases."""
    try:
        return tuple(leg_named(name, legs) for name in others) == legs
    except ValueError:
        return False


def _plain(name: str) -> str:
    return " ".join(name.replace("_", " ").replace("-", " ").split()).casefold()
