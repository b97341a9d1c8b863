"""What walking asks for, and which feet of a run do not do it.

The limits are shares, so that they hold for a robot of any size: see docs/decisions/walking.md.
"""

from __future__ import annotations

from typing import Final

from apnc import metrics
from apnc.features import WalkFeatures

MIN_FORWARD: Final = 0.5
"""Least forward way, as a share of the way along the path [1]."""

MIN_LIFT: Final = 0.02
"""Least lift of a foot that steps, as a share of the length of femur and tibia [1]."""

MAX_SLIP: Final = 0.5
"""Most slip of a foot that steps in a stride, as a share of the stride length [1]."""


def moves(s: WalkFeatures) -> bool:
    """Whether the trunk gets anywhere, in any direction."""
    return s.path_speed_m_per_s is not None and s.path_speed_m_per_s >= metrics.MIN_SPEED


def goes_forward(s: WalkFeatures) -> bool:
    """Whether at least ``MIN_FORWARD`` of the path leads ahead, along the present heading."""
    path, ahead = s.path_speed_m_per_s, s.forward_speed_m_per_s
    return path is not None and ahead is not None and ahead >= MIN_FORWARD * path


def dragging(s: WalkFeatures) -> tuple[str, ...]:
    """Names of the legs whose foot does not step: it lifts too little or slips too far.

    A foot without a stride, or without stance, does not step.
    """
    return tuple(leg for leg in s.foot_lift_share if not _steps(s, leg))


def _steps(s: WalkFeatures, leg: str) -> bool:
    lift, slip = s.foot_lift_share[leg], s.slip_share[leg]
    return lift is not None and slip is not None and lift >= MIN_LIFT and slip <= MAX_SLIP
