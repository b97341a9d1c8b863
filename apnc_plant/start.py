"""Where a robot starts."""

from __future__ import annotations

import numpy as np

from apnc_plant.coordinates import JOINT_SIGN
from apnc_plant.ground.surface import Surface
from apnc_plant.robot.model import Array, RobotDescription
from exudyn_models.physics.forces import leg_points
from exudyn_models.physics.robot_forces import leg_geometry


def start_coordinates(
    robot: RobotDescription, ground: Surface, angles: Array, clearance: float
) -> Array:
    """Tree coordinates of a robot over the origin, parallel to the ground, its feet just above it.

    Args:
        robot: the robot.
        ground: the ground; what is high under the feet lifts the robot.
        angles: abduction, hip and knee of every leg [rad], shape (3,).
        clearance: height of the lowest foot above what is below it [m].
    """
    radius = robot.contact.foot_radius
    feet = [np.array(leg_points(leg, *angles)[2]) for leg in leg_geometry(robot)]
    height = clearance + max(
        ground.rest_height(foot[0], foot[1], radius) - foot[2] for foot in feet
    )
    place = height * ground.rotation()[:, 2]
    base = [*place, 0.0, -ground.slope, 0.0]
    return np.concatenate([base, np.tile(angles * JOINT_SIGN, len(robot.legs))])
