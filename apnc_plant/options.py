"""How a plant is started and integrated."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from apnc_core.in_python import in_python
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
        for name in (f.name for f in fields(self)):
            value, allowed = in_python(getattr(self, name)), "a finite number"
            fits = isinstance(value, int | float) and not isinstance(value, bool)
            fits = fits and math.isfinite(value)
            if name == "step":
                fits, allowed = fits and value > 0.0, f"{allowed} above 0"
            if not fits:
                raise ValueError(f"{name} is {value}; allowed: {allowed}")
            object.__setattr__(self, name, float(value))
