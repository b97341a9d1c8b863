"""How a plant is started and integrated."""

from __future__ import annotations

import math
from dataclasses import dataclass

from apnc_plant.robot.model import GRAVITY


@dataclass(frozen=True)
class PlantOptions:
    """How a plant is started and integrated.

    Args:
        step: longest integration step [s]; a tick is cut into equal steps of at most this. The
            default, 16 steps per tick at 60 Hz, is what the step-size study picked.
        gravity: downward acceleration [m/s^2].
        clearance: height of the lowest foot above the ground at the start [m].
        start_hip, start_knee: joint angles of every leg at the start, relative to the reference
            pose [rad].
    """

    step: float = 1.0 / 960.0
    gravity: float = GRAVITY
    clearance: float = 0.0
    start_hip: float = 0.0
    start_knee: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a step that is not positive and values that are not finite."""
        if not (math.isfinite(self.step) and self.step > 0.0):
            raise ValueError(f"step is {self.step}; allowed: a finite number above 0")
        for name in ("gravity", "clearance", "start_hip", "start_knee"):
            value = getattr(self, name)
            if not math.isfinite(value):
                raise ValueError(f"{name} is {value}; allowed: a finite number")
