"""The walks that a body is judged by."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from apnc.studies.study import WALK_MI

SECONDS: Final = 30.0
"""Length of a walk [s]: 30 strides at the lowest stepping rate."""

WALKS: Final[Mapping[str, Mapping[str, Any]]] = {
    "MI 0.04": {"mi": 0.04},
    "MI 0.08": {"mi": 0.08},
    "MI 0.15": {"mi": 0.15},
    "MI 0.28": {"mi": 0.28},
    "MI 0.40": {"mi": 0.40},
    "20 Hz": {"mi": WALK_MI, "rate": 20.0},
}
"""Fields of the experiment by name of the walk: five MI, and a slow update rate."""
