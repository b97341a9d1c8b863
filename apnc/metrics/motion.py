"""How the trunk moved: speed along the path and ahead, turn, balance and cost of transport."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc.metrics.smoothing import smooth
from apnc_core.types import Array
from apnc_plant.robot.model import GRAVITY

MIN_SPEED: Final = 0.005
"""Path speed below which a robot stands [m/s]: Lilibot rocks in place at 2, walks from 19 mm/s."""
# A spread this small is rounding.
_NO_SWAY: Final = 1e-9


def forward_distance(position: Array, yaw: Array) -> float | None:
    """Net displacement along the initial heading [m]; negative when it walked backwards.

    Pitfall: a robot that turns walks further than this says; see ``path_length``.
    """
    if len(position) < 2:
        return None
    step = position[-1] - position[0]
    return float(step[0] * np.cos(yaw[0]) + step[1] * np.sin(yaw[0]))


def path_length(position: Array) -> float | None:
    """Length of the smoothed horizontal path of the trunk [m].

    Pitfall: unsmoothed, the sway of every stride would count as distance walked.
    """
    if len(position) < 2:
        return None
    steps = np.diff(smooth(position[:, :2]), axis=0)
    return float(np.linalg.norm(steps, axis=1).sum())


def mean_speed(time: Array, distance: float | None) -> float | None:
    """Distance [m] over the time from the first to the last sample [m/s]."""
    return None if distance is None else distance / float(time[-1] - time[0])


def smoothed_speed(time: Array, position: Array, yaw: Array) -> Array:
    """Speed of the smoothed path along the current (smoothed) heading [m/s], shape (T,)."""
    if len(time) < 2:
        return np.full(len(time), np.nan)
    heading = smooth(np.unwrap(yaw))
    velocity = np.gradient(smooth(position[:, :2]), time, axis=0)
    speed: Array = velocity[:, 0] * np.cos(heading) + velocity[:, 1] * np.sin(heading)
    return speed


def turned(yaw: Array) -> float | None:
    """Angle [rad] by which the trunk turned to the left over the run, beyond pi if it did."""
    angle = np.unwrap(yaw)
    return float(angle[-1] - angle[0]) if len(angle) else None


def balance(roll: Array, pitch: Array, speed: float | None) -> float | None:
    """Balance of Fig. 7 [1/rad]: 1/std(roll) + 1/std(pitch).

    None if the robot stands, since a robot at rest has the best balance of all, or if the trunk did
    not tilt. Pitfall: a slow robot sways less; read it with the speed.
    """
    if speed is None or speed < MIN_SPEED:
        return None
    spreads = [float(roll.std()), float(pitch.std())]
    return sum(1.0 / s for s in spreads) if min(spreads) > _NO_SWAY else None


def cost_of_transport(
    time: Array, work: Array, mass: float, distance: float | None
) -> float | None:
    """Cost of transport of Fig. 7 [1]: integral of abs(torque speed) dt over m g distance.

    ``work`` (T, ...) is what every servo did since the start [J], abs(torque speed) summed at every
    integration step; at 60 Hz, as the authors sum it, a tenth is missed. ``mass`` [kg] of the
    robot, ``distance`` along the path [m]. None if the robot stands. Pitfall: braking power counts
    as spent, since a geared servo does not recover it.
    """
    speed = mean_speed(time, distance)
    if distance is None or speed is None or speed < MIN_SPEED:
        return None
    total = work.reshape(len(time), -1).sum(axis=1)
    return float(total[-1] - total[0]) / (mass * GRAVITY * distance)
