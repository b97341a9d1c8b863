"""Start coordinates of a robot."""

from __future__ import annotations

import numpy as np

from apnc_core.types import Array
from apnc_plant.ground import GroundInC
from apnc_plant.library import library
from apnc_plant.numbers import Numbers
from apnc_plant.options import PlantOptions


def start_coordinates(robot: Numbers, ground: GroundInC, options: PlantOptions) -> Array:
    """Coordinates of a robot over the origin, parallel to the ground, with its feet just above it.

    Args:
        robot: the robot.
        ground: the ground; the robot is lifted if the ground is higher under its feet.
        options: joint angles at the start and height of the lowest foot.

    Returns:
        x, y, z [m], yaw, pitch, roll [rad] of the trunk, then abduction, hip and knee of every leg
        [rad], shape (6 + 3 n_legs,).

    Raises:
        ValueError: the touch function of a ground of one's own raised an error.
    """
    ffi, lib = library()
    coordinates = np.zeros(6 + 3 * robot.at.legs)
    angles = [0.0, options.start_hip, options.start_knee]
    written = ffi.from_buffer("double[]", coordinates)
    lib.plant_start(robot.at, ground.at, angles, options.clearance, ground.found, written)
    ground.check()
    return coordinates
