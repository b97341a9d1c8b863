"""The runs of a candidate and their costs, which are 0 for a perfect walk.

A run that is not complete, since the robot fell or the motion diverged, costs ``FAILED``. All runs
of all candidates walk in C, side by side.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np

from apnc import metrics
from apnc.feet import Feet
from apnc.loop.experiment import Experiment
from apnc.loop.many import walk_many
from apnc.loop.record import Record
from apnc.studies.search.design import Candidate, built_robot, gains
from apnc.studies.states.measure import STOPPED, judge
from apnc.studies.states.timeline import Timeline
from apnc.studies.study import SCHEDULE_MI, WALK_MI
from apnc_core.settings import SettingLike
from apnc_core.types import Array
from apnc_plant.conditions import ALL, Conditions
from apnc_plant.robot import RobotDescription, load_robot

FAILED: Final = 10.0

WALK_S: Final = 15.0
LAST_S: Final = 7.0
"""Length of a walk [s], and of its last part, in which feet, speed and turn are measured [s]."""

BANDS: Final = {
    4: (
        (0.08, 0.06, 0.07), (0.10, 0.12, 0.13), (SCHEDULE_MI,), (0.20, 0.18, 0.22, 0.24),
        (0.28, 0.26, 0.30), (0.34, 0.32, 0.36), (0.40,),
    ),
    6: ((WALK_MI,), (0.10, 0.09, 0.11), (0.12, 0.13), (SCHEDULE_MI,), (0.18, 0.20)),
    8: ((WALK_MI,), (0.10, 0.09, 0.11), (0.12, 0.13), (SCHEDULE_MI,), (0.18, 0.20)),
}  # fmt: skip
"""Bands of MI by number of legs. A generation walks at one MI of each band, in turn."""

FASTEST: Final = 0.40
"""MI of the fast walk, for four legs."""

RATES: Final = (25.0, 45.0, 15.0, 30.0, 20.0, 10.0)
"""Update rates [Hz], in turn."""

WANTED_LIFT: Final = 0.0075
"""Lift of every foot in mid-swing without cost [m]: the aim of 6 mm and a margin."""

WANTED_SLIP: Final = 0.10
"""Slip per stride over the stride length without cost [1]: the aim of 0.12 and a margin."""

WANTED_TURN: Final = math.radians(10.0) / 45.0
"""Scale of the cost of the turning rate of a straight walk [rad/s]."""

WANTED_STEERING: Final = 0.29
"""Turning rate at half steering without cost [rad/s]: the aim of 0.25 and a margin."""

WANTED_RATIO: Final = 2.0
"""Speed at MI 0.4 over that at MI 0.15 without cost [1]: the paper's."""

MARGIN: Final = 0.93
"""Factor on the learning rates at which an oscillator under a stuck load must still stop [1]."""

HELD_AT: Final = 0.05
"""Height above its start at which the robot is held [m]. No foot reaches the ground."""

STUCK_AT: Final = 5.0
"""Time at which the sensors of the held robot stick [s]."""

MEMORY: Final = Timeline(lowered=0.0, broken=3.0, stopped=8.0, restarted=9.0, end=17.0)

INEXACT: Final = (0.16, -0.09, 0.12, -0.05, 0.1, -0.12, 0.08)
"""Difference of the stored gait from the exact one [rad]. Measured relations are never exact."""

OTHERS: Final = ("ratio", "rate", "payload", "damage", "memory", "steering", "blocked")


def names(n_legs: int) -> tuple[str, ...]:
    """Names of the costs: formation at the MI of each band, feet at the same, then ``OTHERS``."""
    bands = [f"{band[0]:.2f}" for band in BANDS[n_legs]]
    return (*(f"mi_{mi}" for mi in bands), *(f"feet_{mi}" for mi in bands), *OTHERS)


Figures = Mapping[str, float]
"""Costs [1], and speeds [m/s] from which costs are made, by name."""


class Task(NamedTuple):
    """A run of a candidate, and the function that takes measures of its record."""

    experiment: Experiment
    judge: Callable[[Record], Figures]


def costs_of(
    candidates: Sequence[Candidate],
    seed: int,
    robot_name: str = "lilibot",
    controller: str = "apnc",
    workers: int = 1,
) -> list[tuple[float, ...]]:
    """Costs of candidates in the order of ``names``.

    All costs of a candidate that cannot be run are ``FAILED``.

    Args:
        candidates: candidates, all of which run with the same seeds.
        seed: seed of their runs.
        robot_name: name of the robot.
        controller: name of the controller.
        workers: threads.
    """
    n_legs = len(load_robot(robot_name).legs)
    found: list[dict[str, float]] = [{} for _ in candidates]
    asked: list[tuple[int, Task]] = []
    failed: set[int] = set()
    for n, candidate in enumerate(candidates):
        try:
            asked += [(n, task) for task in tasks(candidate, seed, robot_name, controller)]
        except ValueError:  # not a robot, or not parameters
            failed.add(n)
    for at, figures in walk_many(
        [task.experiment for _, task in asked],
        lambda at, record: asked[at][1].judge(record),
        workers=workers,
    ):
        n, _ = asked[at]
        if not isinstance(figures, Exception):
            found[n].update(figures)
        elif isinstance(figures, ValueError | RuntimeError):
            failed.add(n)
        else:
            raise figures
    worst = (FAILED,) * len(names(n_legs))
    return [worst if n in failed else costs(own, n_legs) for n, own in enumerate(found)]


def costs(found: Figures, n_legs: int) -> tuple[float, ...]:
    """Costs in the order of ``names``, of measures of all runs; 0 for runs that are not made."""
    own = dict(found)
    if (fast := own.get(_speed(FASTEST))) is not None:
        own["ratio"] = 1.5 * ratio_cost(own[_speed(SCHEDULE_MI)], fast)
    return tuple(own.get(name, 0.0) for name in names(n_legs))


def _speed(mi: float) -> str:
    return f"speed at {mi:.2f}"


def tasks(
    candidate: Candidate, seed: int, robot_name: str = "lilibot", controller: str = "apnc"
) -> Iterator[Task]:
    """The runs of a candidate.

    Memory, steering and a blocked oscillator are run for APNC only. Payload, the fast walk, other
    update rates and steering are run for four legs only.

    Raises:
        ValueError: numbers that are no robot, or no parameters of the controller.
    """
    robot, settings = built_robot(candidate, robot_name), gains(candidate)
    n_legs, own = len(robot.legs), controller == "apnc"
    bands, four = BANDS[n_legs], n_legs == 4
    seeds = itertools.count(100 * seed)  # another asymmetry and noise in every trial

    def walk(mi: float, **more: Any) -> Experiment:
        what = {
            "robot": robot,
            "settings": settings,
            "controller": controller,
            "duration": WALK_S,
            **more,
        }
        return Experiment(mi=mi, seed=next(seeds), **what)

    # without the couplings at one MI: what they then store must be good by itself
    bare = seed % len(bands)
    for n, band in enumerate(bands):
        mi = band[seed % len(band)]
        yield Task(
            walk(mi, controller="apc" if own and n == bare else controller), _walk_of(band[0])
        )
    if four:
        rate = RATES[seed % len(RATES)]
        slow = walk(WALK_MI, rate=rate, duration=WALK_S * 60.0 / rate)
        yield Task(slow, _cost("rate", formation_cost))
        yield Task(walk(WALK_MI, conditions="C4"), _cost("payload", payload_cost))
    yield Task(walk(SCHEDULE_MI, conditions="C3"), _cost("damage", damage_cost))
    if own:
        gait = np.add(_target(n_legs), INEXACT[: n_legs - 1])
        stored: dict[str, SettingLike] = {"stored": True, "phi_stored": tuple(gait.tolist())}
        kept: dict[str, Any] = {"robot": robot, "settings": {**settings, **stored}}
        memory = MEMORY.experiment("apnc", next(seeds), **kept)
        yield Task(memory, _cost("memory", memory_cost))
        if four:
            turns = Experiment(seed=next(seeds), **STEERING, **kept)
            yield Task(turns, _cost("steering", steering_cost))
        yield Task(blocked(robot, settings), _cost("blocked", lambda r: 3.0 * blocked_cost(r)))


def _cost(name: str, of: Callable[[Record], float]) -> Callable[[Record], Figures]:
    return lambda record: {name: of(record) if record.complete else FAILED}


def _walk_of(band: float) -> Callable[[Record], Figures]:
    """Costs and speed of a walk at an MI of the band that begins with this one."""

    def judge(record: Record) -> Figures:
        walk, feet = (of(record) if record.complete else FAILED for of in (walk_cost, feet_cost))
        return {
            f"mi_{band:.2f}": walk,
            f"feet_{band:.2f}": feet,
            _speed(_mi(record)): walk_speed(record),
        }

    return judge


class _Late:
    """Figures of the last part of a walk: speed [m/s], turning rate [rad/s], and the feet."""

    def __init__(self, record: Record) -> None:
        time, yaw = record.time, record.signals["rpy"][:, 2]
        part = slice(int(np.searchsorted(time, time[-1] - LAST_S)), None)
        self.feet = Feet(record, part)
        ahead = metrics.smoothed_speed(time, record.signals["position"], yaw)
        self.speed = float(ahead[part].mean())
        turned = metrics.turned(yaw[part]) or 0.0
        self.turning = turned / float(time[-1] - time[part][0])

    def foot_costs(self) -> float:
        """Sum over the legs of the costs of lift, slip and touch-downs."""
        stride = max(self.speed, 0.02) / (self.feet.stride_frequency or 1.0)
        feet = self.feet
        return (
            _sum(feet.lifts, lambda lift: min(1.0, max(0.0, 1.0 - lift / WANTED_LIFT)))
            + _sum(feet.slips, lambda slip: min(2.0, max(0.0, slip / stride / WANTED_SLIP - 1.0)))
            + _sum(feet.touch_downs, lambda count: min(1.0, abs(count - 1.0)))
        )


def _sum(figures: Sequence[float | None], cost: Callable[[float], float]) -> float:
    return sum(1.0 if figure is None else cost(figure) for figure in figures)


def formation_cost(record: Record) -> float:
    """Cost of a late or inexact gait. The gait is the one expected for the number of legs."""
    error = _error(record, slice(None))
    last = round(4.0 * record.experiment.rate)
    # far from the gait for long; and at the end not well inside the tolerance
    cost = 2.0 * float(np.clip(error / np.pi, 0.0, 1.0).mean())
    return cost + 1.5 * float(np.clip(error[-last:] - 0.2, 0.0, 1.5).mean())


def walk_cost(record: Record) -> float:
    """Cost of formation and of a slow walk."""
    slow = min(1.0, max(0.0, 0.06 + 0.1 * _mi(record) - walk_speed(record)) / 0.05)
    return formation_cost(record) + slow


def feet_cost(record: Record) -> float:
    """Cost of the feet and of a turn."""
    late = _Late(record)
    turning = 0.35 * math.log1p(abs(late.turning) / WANTED_TURN)
    return 1.4 * late.foot_costs() / len(record.legs) + turning


def walk_speed(record: Record) -> float:
    """Mean speed along the heading at the end [m/s]. 0 for a run that is not complete."""
    return _Late(record).speed if record.complete else 0.0


def payload_cost(record: Record) -> float:
    """Cost of formation and of a slow walk with the payload."""
    slow = min(1.0, max(0.0, 0.05 - _Late(record).speed) / 0.05)
    return formation_cost(record) + slow


def damage_cost(record: Record) -> float:
    """Cost of stopped oscillators and of a slow walk with a damaged leg."""
    last = round(4.0 * record.experiment.rate)
    moved = np.ptp(record.signals["o1"][-last:], axis=0)
    stopped = float(np.clip(1.0 - moved, 0.0, 1.0).sum())
    return 0.5 * stopped + min(1.0, max(0.0, 0.06 - _Late(record).speed) / 0.05)


def ratio_cost(slow: float, fast: float) -> float:
    """Cost of less than twice the speed at MI 0.4."""
    return min(2.0, max(0.0, WANTED_RATIO - fast / max(slow, 0.02)))


def memory_cost(record: Record) -> float:
    """Cost of a lost gait or a slow walk in S2 and S3, with a stored gait."""
    found, cost = judge(record, MEMORY), 0.0
    for begin, end, state in ((3.5, 8.0, "speed_s2"), (14.0, 17.0, "speed_s3")):
        error = _error(record, slice(int(begin * 60), int(end * 60)))
        cost += float(np.clip(error - 0.25, 0.0, 1.5).mean())
        cost += min(1.0, max(0.0, 0.07 - found[state]) / 0.05)
    return cost


STEERING: Final[Mapping[str, Any]] = {
    "mi": SCHEDULE_MI,
    "duration": 12.0,
    "turn": ((0.0, 0.0), (3.0, 0.5), (7.5, -0.5)),
}


def steering_cost(record: Record) -> float:
    """Cost of slow or unequal turns to both sides, with a stored gait."""
    turned = np.unwrap(record.signals["rpy"][:, 2])[[270, 449, 540, 719]]
    left, right = float(turned[1] - turned[0]) / 3.0, float(turned[2] - turned[3]) / 3.0
    slow = sum(min(2.0, max(0.0, 1.0 - rate / WANTED_STEERING)) for rate in (left, right))
    return slow + min(1.0, abs(left - right) / WANTED_STEERING)


def blocked(robot: RobotDescription, settings: Mapping[str, float]) -> Experiment:
    """A robot that is held in the air. Its feet feel no load until all sensors stick at 0.9.

    The learning rates are those of the candidate times ``MARGIN``, and there are no couplings.
    """
    weaker = {name: settings[name] * MARGIN for name in ("B_f", "B_s") if name in settings}
    silent = Conditions(dropout=(ALL,), held_at=HELD_AT)
    stuck = Conditions(stuck={leg.name: 0.9 for leg in robot.legs}, held_at=HELD_AT)
    return Experiment(
        robot=robot,
        mi=SCHEDULE_MI,
        duration=15.0,
        controller="apc",
        settings={**settings, **weaker},
        conditions=((0.0, silent), (STUCK_AT, stuck)),
    )


def blocked_cost(record: Record) -> float:
    """Cost of an oscillator that does not stop once its load sticks. 0 if it stops.

    The cost falls with the rate of the oscillator, so that the search finds the way to the stop.
    """
    o1 = record.signals["o1"][:, 0]
    free, stuck = o1[60:300], o1[-480:]
    if np.ptp(stuck[-240:]) < STOPPED:
        return 0.0
    return min(1.0, 0.2 + 0.5 * _turns(stuck) / max(1, _turns(free)))


def _mi(record: Record) -> float:
    mi = record.experiment.mi
    return float(mi) if isinstance(mi, int | float) else 0.0


def _turns(o1: Array) -> int:
    high = o1 > o1.mean()
    return int(np.count_nonzero(~high[:-1] & high[1:]))


def _error(record: Record, part: slice) -> Array:
    c = record.signals
    error = metrics.phase_error(c["o1"][part], c["o2"][part], _target(len(record.legs)))
    return np.asarray(np.nan_to_num(error, nan=np.pi))


def _target(n_legs: int) -> tuple[float, ...]:
    return metrics.GAITS[n_legs][metrics.gait_name(n_legs)]
