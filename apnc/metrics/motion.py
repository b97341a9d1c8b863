"""How the trunk moved: speed, balance, cost of transport, and whether it fell."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from apnc.metrics.smoothing import smooth

Array = NDArray[np.float64]

GRAVITY: Final = 9.81
FALL_ANGLE: Final = np.deg2rad(60.0)
# About half the height at which Lilibot stands.
FALL_HEIGHT: Final = 0.07
# Slower than this a robot is treading on the spot and has no cost of transport.
MIN_SPEED: Final = 0.005
_NO_SWAY: Final = 1e-9


def forward_distance(position: ArrayLike, yaw: ArrayLike) -> float | None:
    """Straight displacement along the initial heading [m]; negative when it walked backwards.

    Args:
        position: trunk position in the world frame [m], shape (T, 3).
        yaw: trunk yaw [rad], shape (T,); only the first sample is used.
    """
    p = np.asarray(position, dtype=np.float64)
    if len(p) < 2:
        return None
    heading = float(np.asarray(yaw, dtype=np.float64)[0])
    step = p[-1, :2] - p[0, :2]
    return float(step[0] * np.cos(heading) + step[1] * np.sin(heading))


def forward_speed(time: ArrayLike, position: ArrayLike, yaw: ArrayLike) -> float | None:
    """Mean forward speed [m/s]: straight displacement along the initial heading / duration.

    Args:
        time: sample times [s], shape (T,).
        position: trunk position in the world frame [m], shape (T, 3).
        yaw: trunk yaw [rad], shape (T,).

    Pitfall: a robot that turns walks further than this says; see ``path_speed``.
    """
    distance, span = forward_distance(position, yaw), _span(time)
    return distance / span if distance is not None and span > 0 else None


def path_length(position: ArrayLike) -> float | None:
    """Length of the smoothed horizontal path of the trunk [m].

    Args:
        position: trunk position in the world frame [m], shape (T, 3).

    Pitfall: unsmoothed, the sway of every stride would count as distance walked.
    """
    p = np.asarray(position, dtype=np.float64)
    if len(p) < 2:
        return None
    steps = np.diff(smooth(p[:, :2]), axis=0)
    return float(np.linalg.norm(steps, axis=1).sum())


def path_speed(time: ArrayLike, position: ArrayLike) -> float | None:
    """Mean speed along the smoothed horizontal path [m/s].

    Args:
        time: sample times [s], shape (T,).
        position: trunk position in the world frame [m], shape (T, 3).
    """
    length, span = path_length(position), _span(time)
    return length / span if length is not None and span > 0 else None


def smoothed_speed(time: ArrayLike, position: ArrayLike, yaw: ArrayLike) -> Array:
    """Speed of the smoothed path along the current (smoothed) heading [m/s], shape (T,).

    Args:
        time: sample times [s], shape (T,).
        position: trunk position in the world frame [m], shape (T, 3).
        yaw: trunk yaw [rad], shape (T,).
    """
    t = np.asarray(time, dtype=np.float64)
    p = smooth(np.asarray(position, dtype=np.float64)[:, :2])
    if len(t) < 2:
        return np.full(len(t), np.nan)
    heading = smooth(np.unwrap(np.asarray(yaw, dtype=np.float64)))
    velocity = np.gradient(p, t, axis=0)
    speed: Array = velocity[:, 0] * np.cos(heading) + velocity[:, 1] * np.sin(heading)
    return speed


def balance(roll: ArrayLike, pitch: ArrayLike) -> float | None:
    """Balance of Fig. 7 [1/rad]: 1/std(roll) + 1/std(pitch).

    Args:
        roll: trunk roll [rad], shape (T,).
        pitch: trunk pitch [rad], shape (T,).

    Returns:
        None if the trunk did not move at all.

    Pitfall: a robot that stands still has the best balance of all; read it with the speed.
    """
    angles = [np.asarray(a, dtype=np.float64) for a in (roll, pitch)]
    spreads = [float(a.std()) if a.size else 0.0 for a in angles]
    return sum(1.0 / s for s in spreads) if min(spreads) > _NO_SWAY else None


def cost_of_transport(
    time: ArrayLike, work: ArrayLike, mass: float, distance: float | None
) -> float | None:
    """Cost of transport of Fig. 7 [1]: integral of abs(torque speed) dt over m g distance.

    Args:
        time: sample times [s], shape (T,).
        work: what every servo did since the start, its abs(torque speed) summed at every
            integration step [J], shape (T, ...).
        mass: mass of the robot [kg].
        distance: distance walked [m], for instance ``path_length``.

    Returns:
        None if the robot did not get anywhere (mean speed below 5 mm/s).

    Pitfall: braking power counts as spent, since a geared servo does not recover it. Torque times
    speed at 60 Hz, as the authors sum it, misses about a tenth.
    """
    t = np.asarray(time, dtype=np.float64)
    span = _span(t)
    if distance is None or span <= 0 or distance / span < MIN_SPEED or mass <= 0:
        return None
    total = np.asarray(work, dtype=np.float64).reshape(len(t), -1).sum(axis=1)
    return float(total[-1] - total[0]) / (mass * GRAVITY * distance)


def fell(
    roll: ArrayLike, pitch: ArrayLike, height: ArrayLike, min_height: float = FALL_HEIGHT
) -> bool:
    """Whether the trunk ever tilted beyond 60 deg in roll or pitch, or sank below a height.

    Args:
        roll: trunk roll [rad], shape (T,).
        pitch: trunk pitch [rad], shape (T,).
        height: height of the trunk reference point above the ground [m], shape (T,).
        min_height: height below which the trunk lies rather than stands [m].
    """
    tilt = np.maximum(np.abs(np.asarray(roll)), np.abs(np.asarray(pitch)))
    return bool((tilt > FALL_ANGLE).any() or (np.asarray(height) < min_height).any())


def _span(time: ArrayLike) -> float:
    t = np.asarray(time, dtype=np.float64)
    return float(t[-1] - t[0]) if len(t) > 1 else 0.0
