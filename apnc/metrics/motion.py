"""Motion of the trunk: speed, turn, balance and cost of transport."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc.metrics.smoothing import smooth
from apnc_core.types import Array
from apnc_plant.robot.model import GRAVITY

MIN_SPEED: Final = 0.005
"""Path speed below which a robot stands [m/s]. Lilibot rocks in place at 2 and walks at 19 mm/s."""

_NO_SWAY: Final = 1e-9
"""Standard deviation of an angle that is rounding [rad]."""


def forward_distance(position: Array, yaw: Array) -> float | None:
    """Net displacement along the initial heading [m]; negative for a walk backwards.

    Pitfall: a robot that turns walks further than this, see :func:`path_length`.
    """
    if len(position) < 2:
        return None
    step = position[-1] - position[0]
    return float(step[0] * np.cos(yaw[0]) + step[1] * np.sin(yaw[0]))


def path_length(position: Array) -> float | None:
    """Length of the smoothed horizontal path of the trunk [m].

    Pitfall: without smoothing, the sway in every stride would add to the length.
    """
    if len(position) < 2:
        return None
    steps = np.diff(smooth(position[:, :2]), axis=0)
    return float(np.linalg.norm(steps, axis=1).sum())


def mean_speed(time: Array, distance: float | None) -> float | None:
    """Distance over the time from the first to the last sample [m/s].

    Args:
        time: see ``apnc.metrics``.
        distance: covered in that time [m]; None gives None.
    """
    return None if distance is None else distance / float(time[-1] - time[0])


def smoothed_speed(time: Array, position: Array, yaw: Array) -> Array:
    """Speed of the smoothed path along the smoothed heading at each sample [m/s], shape (T,)."""
    if len(time) < 2:
        return np.full(len(time), np.nan)
    heading = smooth(np.unwrap(yaw))
    velocity = np.gradient(smooth(position[:, :2]), time, axis=0)
    speed: Array = velocity[:, 0] * np.cos(heading) + velocity[:, 1] * np.sin(heading)
    return speed


def turned(yaw: Array) -> float | None:
    """Angle by which the trunk turned to the left over the run [rad]; it may exceed pi."""
    angle = np.unwrap(yaw)
    return float(angle[-1] - angle[0]) if len(angle) else None


def heading_range(yaw: Array) -> tuple[float, float] | None:
    """Least and largest turn to the left from the first heading [rad]; both may exceed pi."""
    angle = np.unwrap(yaw)
    if not len(angle):
        return None
    return float(angle.min() - angle[0]), float(angle.max() - angle[0])


def forward_speed(time: Array, position: Array, yaw: Array) -> float | None:
    """Mean of :func:`smoothed_speed` [m/s]: along the present heading, negative backwards."""
    return float(smoothed_speed(time, position, yaw).mean()) if len(time) > 1 else None


def balance(roll: Array, pitch: Array, speed: float | None) -> float | None:
    """Balance of Fig. 7: 1 / std(roll) + 1 / std(pitch) [1/rad].

    None if the robot stands, since standing would give the best balance, or if the trunk did not
    tilt. Pitfall: a slow robot sways less, so compare balances at the same speed.
    """
    if speed is None or speed < MIN_SPEED:
        return None
    spreads = [float(roll.std()), float(pitch.std())]
    return sum(1.0 / s for s in spreads) if min(spreads) > _NO_SWAY else None


def cost_of_transport(
    time: Array, work: Array, mass: float, distance: float | None
) -> float | None:
    """Cost of transport of Fig. 7: integral of abs(torque speed) dt over m g distance [1].

    None if the robot stands. Pitfall: braking power counts as spent, since a geared servo does not
    recover it.

    Args:
        time: see ``apnc.metrics``.
        work: integral of abs(torque speed) of each servo since the start [J], shape (T, ...). It is
            summed at every integration step; a sum at 60 Hz, as the authors', misses a tenth.
        mass: of the robot [kg].
        distance: along the path [m].
    """
    speed = mean_speed(time, distance)
    if distance is None or speed is None or speed < MIN_SPEED:
        return None
    total = work.reshape(len(time), -1).sum(axis=1)
    return float(total[-1] - total[0]) / (mass * GRAVITY * distance)
