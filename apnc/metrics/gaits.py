"""Gaits by name: the relative phases that the legs of a robot have in each."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from apnc.metrics.phases import wrap

_HALF_TURNS: Final[dict[int, dict[str, tuple[float, ...]]]] = {
    4: {
        "trot": (1, 1, 0),
        "pace": (0, 1, 1),
        "bound": (1, 0, 1),
        "walk": (1 / 2, 1, 3 / 2),
        "pronk": (0, 0, 0),
    },
    6: {
        "tripod": (1, 0, 1, 0, 1),
        "tetrapod": (2 / 3, 4 / 3, 4 / 3, 0, 2 / 3),
        "wave": (1 / 3, 2 / 3, 1, 4 / 3, 5 / 3),
        "direct wave of pairs": (2 / 3, 4 / 3, 0, 2 / 3, 4 / 3),
        "retrograde wave of pairs": (4 / 3, 2 / 3, 0, 4 / 3, 2 / 3),
        "ripple": (2 / 3, 4 / 3, 1, 5 / 3, 1 / 3),
        "pronk": (0, 0, 0, 0, 0),
    },
    8: {
        "alternating tetrapod": (1, 0, 1, 1, 0, 1, 0),
        "direct wave of pairs": (1 / 2, 1, 3 / 2, 0, 1 / 2, 1, 3 / 2),
        "retrograde wave of pairs": (3 / 2, 1, 1 / 2, 0, 3 / 2, 1, 1 / 2),
        "pronk": (0, 0, 0, 0, 0, 0, 0),
    },
}
GAITS: Final = {
    n: {name: tuple(np.pi * half for half in gait) for name, gait in gaits.items()}
    for n, gaits in _HALF_TURNS.items()
}
"""Number of legs -> name -> phi_12 .. phi_1n [rad], positive where leg k is ahead of leg 1.

Legs are in the FMU's order: right from front to hind, then left (RF, RH, LF, LH). The first gait of
each number of legs is the expected one. For four legs it is the trot of the paper.

- Four legs: Alexander 1984. In the walk a hind foot is a quarter of a cycle ahead of the front foot
  of its side.
- Six legs: Wilson 1966, with waves from hind to front. Ripple: Ferrell 1994; one leg of each side
  swings at a time, and the sides are half a cycle apart.
- Eight legs: Spagna and Peattie 2012.
- In a wave of pairs left and right swing together, and the pairs follow one another: from hind to
  front in a direct wave, as in millipedes, and from front to hind in a retrograde wave. Kuroda et
  al. 2014 name the directions.
"""


def default_target(n_legs: int) -> tuple[float, ...] | None:
    """Relative phases [rad] of the gait expected of ``n_legs`` legs; None if none is known."""
    return next(iter(GAITS.get(n_legs, {}).values()), None)


def gait_name(n_legs: int) -> str:
    """Name of the gait expected of ``n_legs`` legs; "gait" if none is known."""
    return next(iter(GAITS.get(n_legs, {})), "gait")


def nearest_gait(phases: ArrayLike, tolerance: float) -> str | None:
    """Name of the gait with the smallest largest deviation from the relative phases.

    Args:
        phases: phi_12 .. phi_1n [rad], shape (n - 1,).
        tolerance: largest deviation that is allowed [rad].

    Returns:
        None if no gait is within the tolerance or a phase is undefined.
    """
    measured = np.asarray(phases, dtype=np.float64)
    known = GAITS.get(len(measured) + 1, {})
    errors = {name: float(np.abs(wrap(measured - gait)).max()) for name, gait in known.items()}
    nearest = min(errors, key=errors.__getitem__, default=None)
    return nearest if nearest and errors[nearest] <= tolerance else None
