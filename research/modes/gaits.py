"""The gaits to compare: those with a name, and one of six legs made of a load pattern."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from apnc import metrics

CANDIDATES: Final = {
    **metrics.GAITS,
    6: {**metrics.GAITS[6], "twist": (0.0, np.pi, np.pi, np.pi, 0.0)},
}
"""Number of legs -> name -> phi_12 .. phi_1n [rad].

``twist``: front and hind of a side half a cycle apart, the sides opposed.
"""


def mirrored(gait: ArrayLike) -> np.ndarray:
    """The gait with left and right exchanged, phi_12 .. phi_1n [rad]."""
    right, left = np.split(np.concatenate([[0.0], np.asarray(gait, dtype=np.float64)]), 2)
    phases = np.concatenate([left, right])
    return np.asarray(phases[1:] - phases[0])


def gait_of(phases: ArrayLike) -> str:
    """Name of the nearest candidate or its mirror image within the strict tolerance, or "other".

    Args:
        phases: phi_12 .. phi_1n [rad].
    """
    measured = np.asarray(phases, dtype=np.float64)
    errors = {
        name: min(np.abs(metrics.wrap(measured - each)).max() for each in (gait, mirrored(gait)))
        for name, gait in CANDIDATES[len(measured) + 1].items()
    }
    nearest = min(errors, key=errors.__getitem__)
    return nearest if errors[nearest] <= metrics.STRICT_TOLERANCE else "other"
