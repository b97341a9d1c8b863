"""What a search measures of a run. Lengths count in leg lengths L, speeds in sqrt(g L).

A gait counts only if the robot walks: else a search finds robots that march on the spot.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from apnc import metrics
from apnc.feet import Feet
from apnc.loop.record import Record
from apnc.tune.design import Start
from apnc.tune.runs import Task
from apnc_core.types import Array
from apnc_plant.robot import RobotDescription

MIN_SPEED: Final = 0.045
"""Least speed of a walk [sqrt(g L)]."""

MIN_LIFT: Final = 0.025
"""Least lift in mid-swing of a foot that steps [L]."""

MAX_SLIP: Final = 0.30
"""Most slip of a foot that steps, as a share of the stride [1]."""

WANTED_LIFT: Final = 0.06
"""Lift of every foot without cost [L]: the aim of 0.05 and a margin."""

WANTED_LIFT_OF_PAPER: Final = 0.05
"""The same for a robot that is to repeat the paper [L]."""

WANTED_SLIP: Final = 0.12
"""Slip without cost, as a share of the stride [1]: the aim of 0.18 and a margin."""

LATE: Final = 0.45
"""Last part of a run, in which feet, speed and turn are measured, as a share of it."""

END: Final = 0.25
"""Last part of a run, at which the gait must be exact, as a share of it."""

SIGNALS: Final = frozenset({
    "o1", "o2", "position", "rpy", "joint_torque", "joint_work", "foot_position", "foot_force",
})  # fmt: skip
"""Signals of a run that are needed to measure it."""

SATURATED: Final = 0.97
"""Share of its limit from which on a torque counts as saturated [1]."""


@dataclass(frozen=True)
class Measured:
    """What a search measures of a run.

    Args:
        kind, share: those of its :class:`Task`.
        fell: when it fell or diverged, as a share of the run; 1 if it did not.
        strict: whether the gait of these legs formed and held, by the strict criterion.
        time: from the touch moment until then, in the time of Lilibot's size [s]; nan without.
        mean_error: mean of the largest deviation of a phase from the gait [rad].
        end_error: mean of what is above 0.2 rad of it at the end [rad].
        speed: along the heading [sqrt(g L)].
        lift: lift in mid-swing of the foot that lifts least [L].
        slip: slip in a stride of the foot that slips most, as a share of the stride [1].
        feet: costs of the feet, their mean [1].
        turning: turning rate, in the time of Lilibot's size [rad/s].
        saturated: share of joints and time in which the torque is at its limit [1].
        transport: cost of transport [1].
    """

    kind: str
    share: float
    fell: float
    strict: bool
    time: float
    mean_error: float
    end_error: float
    speed: float
    lift: float
    slip: float
    feet: float
    turning: float
    saturated: float
    transport: float

    @property
    def walks(self) -> bool:
        """Whether it gets ahead on feet that step."""
        return (
            self.fell == 1.0
            and self.speed >= MIN_SPEED
            and self.lift >= MIN_LIFT
            and self.slip <= MAX_SLIP
        )

    @property
    def good(self) -> bool:
        """Whether the gait formed, held, and is a walk."""
        return self.strict and self.walks


def measured(start: Start, task: Task, record: Record) -> Measured:
    """Measure a run."""
    ticks = task.experiment.ticks
    if not record.complete or len(record.time) < ticks:
        return fallen(task, len(record.time) / ticks)
    signals, n = record.signals, len(record.legs)
    time, o1, o2 = record.time, signals["o1"], signals["o2"]
    error = metrics.phase_error(o1, o2, target(n))
    error[np.isnan(error)] = np.pi
    touch = metrics.touch_moment(signals["foot_force"][..., 2], record.mass * metrics.GRAVITY)
    settled = metrics.settling_time(time, error, touch)
    late = slice(ticks - round(LATE * ticks), None)
    yaw, where = signals["rpy"][late, 2], signals["position"][late]
    ahead = metrics.smoothed_speed(time[late], where, yaw)
    speed = float(ahead.mean())
    feet = Feet(record, late)
    lifts, slips, cost = _feet(
        feet, speed, start.length, WANTED_LIFT_OF_PAPER if start.paper else WANTED_LIFT
    )
    turn = metrics.turned(yaw) or 0.0
    stall = _stall_torques(record.robot)
    torque = np.abs(signals["joint_torque"][late])
    work = signals["joint_work"][late][[0, -1]].reshape(2, -1).sum(axis=1)
    way = max(speed, MIN_SPEED * start.gravity_speed) * float(time[-1] - time[late][0])
    return Measured(
        task.kind,
        task.share,
        1.0,
        settled is not None,
        float("nan") if settled is None else settled / start.time,
        float(error.mean()),
        float(np.clip(error[-round(END * ticks) :] - 0.2, 0.0, 1.5).mean()),
        speed / start.gravity_speed,
        lifts,
        slips,
        cost,
        turn / float(time[-1] - time[late][0]) * start.time,
        float((torque > SATURATED * stall).mean()),
        float(work[-1] - work[0]) / (record.mass * metrics.GRAVITY * way),
    )


def target(n_legs: int) -> Array:
    """Phases of the gait that these legs are to find [rad], shape (n - 1,).

    Raises:
        ValueError: no gait is known for this number of legs.
    """
    found = metrics.default_target(n_legs)
    if found is None:
        raise ValueError(f"no gait is known for {n_legs} legs; allowed: 4, 6 or 8")
    return np.asarray(found)


@lru_cache
def _stall_torques(robot: RobotDescription) -> Array:
    """Largest torque of every servo [N m], shape (n, 3)."""
    common = robot.servo.stall_torque
    return np.array([
        [
            robot.servo.own_of_joint(joint, leg.servo).get("stall_torque", common)
            for joint in ("abduction", "hip", "knee")
        ]
        for leg in robot.legs
    ])  # fmt: skip


def _feet(
    feet: Feet, speed: float, length: float, wanted_lift: float
) -> tuple[float, float, float]:
    """Lift [L], slip [1], and the mean cost of the feet."""
    stride = max(speed, 0.02 * math.sqrt(length / 0.155)) / (feet.stride_frequency or 1.0)
    lifts = [0.0 if lift is None else lift / length for lift in feet.lifts]
    slips = [1.0 if slip is None else slip / stride for slip in feet.slips]
    downs = [0.0 if count is None else count for count in feet.touch_downs]
    cost = (
        _mean(lifts, lambda lift: min(1.0, max(0.0, 1.0 - lift / wanted_lift)))
        + _mean(slips, lambda slip: min(2.0, max(0.0, slip / WANTED_SLIP - 1.0)))
        + _mean(downs, lambda count: min(1.0, abs(count - 1.0)))
    )
    return min(lifts), max(slips), cost


def _mean(figures: Sequence[float], cost: Callable[[float], float]) -> float:
    return sum(map(cost, figures)) / len(figures)


def fallen(task: Task, share: float) -> Measured:
    """What is measured of a run that fell or diverged at a share of it."""
    nan = float("nan")
    return Measured(
        task.kind, task.share, min(share, 0.999), False, nan, np.pi, 1.5, 0.0, 0.0, 1.0, 4.0,
        0.0, 0.0, 0.0,
    )  # fmt: skip
