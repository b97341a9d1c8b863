"""What a tuned robot is to reach."""

from __future__ import annotations

from typing import Final

AIM_ALONE: Final = 0.9
"""Share of walks without couplings that are to form the gait [1]."""

AIM_LIFT: Final = 0.05
"""Lift of every foot that is aimed at [L]."""

AIM_SLIP: Final = 0.18
"""Slip of every foot that is aimed at, as a share of the stride [1]."""
