"""Walks by which a robot of the gallery is judged, on seeds that no search has used."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.features import walk_features
from apnc.feet import Feet
from apnc.loop.experiment import Experiment
from apnc.loop.many import walk_many
from apnc.loop.record import Record
from apnc.tune import MI_AIMED
from apnc.varied import varied
from apnc.walking import goes_forward, moves
from apnc_plant.robot import RobotDescription
from apnc_plant.robot.size import mean_leg_length

FIRST_SEED: Final = 2**32
"""Seeds from here on are used by no search, nor by its own checks."""

CONTROLLERS: Final = {"ANC": "apnc", "APC": "apc"}
"""Labels of the controllers: with couplings, and adaptive physical communication alone."""

MI_COUNT: Final = 5
WALK_S: Final = 30.0
"""Length of a walk [s] of a robot that takes 60 ticks a second, others take as many ticks."""

USUAL_RATE: Final = 60.0
LATE: Final = 0.5
"""Last part of a walk, in which speed and feet are measured, as a share of it."""

OFF: Final = 0.1
"""How far every uncertain number of a varied body is off at most [1]."""


@dataclass(frozen=True)
class Walk:
    """What is measured of one walk.

    Args:
        robot: name in the gallery.
        body: ``own``, or ``varied`` by ``OFF``.
        controller: label in ``CONTROLLERS``.
        mi: modulatory input [1].
        seed: of sensors, asymmetry and the varied body.
        end: complete, fell or diverged.
        strict: whether the gait formed and held by the strict criterion, and the robot went ahead.
        convergence_time_s: from the touch moment until then [s]; None if it did not form.
        speed_m_per_s: along the heading in the last half [m/s].
        lift_share: lift of the foot that lifts least, in leg lengths; 0 if a foot does not step.
        slip_share: slip of the foot that slips most, as a share of the stride; None without.
    """

    robot: str
    body: str
    controller: str
    mi: float
    seed: int
    end: str
    strict: bool
    convergence_time_s: float | None
    speed_m_per_s: float
    lift_share: float
    slip_share: float | None


def mi_values(robot: RobotDescription) -> list[float]:
    """Five MI over the range of a robot, each by the same factor above the one before.

    A robot whose file says none walks over the range that ``apnc tune`` aims at.
    """
    low, high = robot.mi_range or MI_AIMED
    return [round(float(mi), 4) for mi in np.geomspace(low, high, MI_COUNT)]


def duration_of(robot: RobotDescription) -> float:
    """Length of a walk of a robot [s]."""
    return WALK_S * USUAL_RATE / (robot.rate or USUAL_RATE)


def experiments(robot: RobotDescription, seeds: int) -> Iterator[tuple[str, str, Experiment]]:
    """Body, label of the controller and experiment of every walk."""
    given: dict[str, Any] = {"engine": "compiled", "duration": duration_of(robot)}
    for seed in range(FIRST_SEED, FIRST_SEED + seeds):
        off = varied(robot, OFF, np.random.default_rng(seed))
        # the controller of a varied body knows the weight of the robot's file
        knows = {"robot_weight": robot.weight}
        for body, walking, settings in (("own", robot, {}), ("varied", off, knows)):
            for mi in mi_values(robot):
                for label, controller in CONTROLLERS.items():
                    yield body, label, Experiment(
                        robot=walking, mi=mi, seed=seed, controller=controller, settings=settings,
                        **given,
                    )  # fmt: skip


def walks(
    name: str,
    robot: RobotDescription,
    seeds: int,
    workers: int,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> list[Walk]:
    """Walk a robot and measure every walk.

    Args:
        name: of the robot in the gallery.
        robot: its tuned file.
        seeds: number of seeds at each MI.
        workers: number of threads.
        progress: called after every walk with the number of walks done and of all.
    """
    plan = list(experiments(robot, seeds))
    found: list[Walk | None] = [None] * len(plan)

    def measure(index: int, record: Record) -> Walk:
        body, label, _ = plan[index]
        return measured(name, body, label, record)

    work = walk_many([experiment for _, _, experiment in plan], measure, workers=workers)
    for done, (index, result) in enumerate(work, 1):
        if isinstance(result, Exception):
            raise result
        found[index] = result
        progress(done, len(plan))
    return [walk for walk in found if walk is not None]


def measured(name: str, body: str, label: str, record: Record) -> Walk:
    """Measure one walk."""
    whole, experiment = walk_features(record), record.experiment
    assert isinstance(experiment.mi, float)
    ahead, lift, slip = 0.0, 0.0, None
    if record.complete:
        late = slice(round(LATE * len(record.time)), None)
        place, yaw = record.signals["position"][late], record.signals["rpy"][late, 2]
        ahead = float(metrics.smoothed_speed(record.time[late], place, yaw).mean())
        lift, slip = _worst(Feet(record, late), mean_leg_length(record.robot))
    return Walk(
        name, body, label, experiment.mi, experiment.seed, whole.end,
        bool(whole.converged) and moves(whole) and goes_forward(whole), whole.convergence_time_s,
        ahead, lift, slip,
    )  # fmt: skip


def _worst(feet: Feet, length: float) -> tuple[float, float | None]:
    """Least lift in leg lengths, and most slip as a share of the stride."""
    lift = min(0.0 if each is None else each / length for each in feet.lifts)
    stride, slips = feet.stride_length, [each for each in feet.slips if each is not None]
    if not stride or len(slips) < len(feet.slips):
        return lift, None
    return lift, max(slips) / stride


def chosen(found: Sequence[Walk], **wanted: object) -> list[Walk]:
    """Walks whose fields have the values that are given."""
    return [
        walk for walk in found
        if all(getattr(walk, name) == value for name, value in wanted.items())
    ]  # fmt: skip


def median(values: Sequence[float | None]) -> float:
    """Median of the values that are there; nan if more than half of them are not."""
    there = [value for value in values if value is not None]
    return float(np.median(there)) if there and 2 * len(there) >= len(values) else math.nan
