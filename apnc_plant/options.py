"""Options of a plant: start and integration."""

from __future__ import annotations

from typing import Annotated

from apnc_plant.files import Number, checked, limits
from apnc_plant.robot.model import GRAVITY


@checked(ValueError)
class PlantOptions:
    """Start and integration of a plant.

    Args:
        step: longest integration step [s]; a tick is divided into equal steps of at most this. The
            robot's own if omitted, see ``apnc_plant.step``.
        gravity: downward acceleration [m/s^2].
        clearance: height of the lowest foot above the ground at the start [m].
        start_hip, start_knee: joint angles of every leg at the start, relative to the reference
            pose [rad].

    Raises:
        ValueError: a step that is not positive, or a value that is no finite number.
    """

    step: Annotated[Number, limits("s", gt=0.0)] | None = None
    gravity: Annotated[Number, limits("m/s^2")] = GRAVITY
    clearance: Annotated[Number, limits("m")] = 0.0
    start_hip: Annotated[Number, limits("rad")] = 0.0
    start_knee: Annotated[Number, limits("rad")] = 0.0
