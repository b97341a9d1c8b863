"""What a candidate must do, in short runs, and how far it is from that; 0 is perfect.

A run that does not come to its end, since the robot fell or the motion diverged, costs ``FAILED``.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.loop.experiment import Experiment, Setting
from apnc.loop.record import Record
from apnc.loop.simulate import simulate
from apnc.studies.search.knobs import Candidate, built_robot, gains
from apnc.studies.states.measure import STOPPED, judge
from apnc.studies.states.timeline import Timeline
from apnc.studies.study import COURSE_MI
from exudyn_models.conditions import Conditions
from exudyn_models.robot import RobotDescription
from exudyn_models.trace import Trace

Array = NDArray[np.float64]
Cost = Callable[[Record, float], float]
"""Cost of a walk that came to its end, with the speed asked for [m/s]."""

FAILED: Final = 10.0

TRIAL_TICKS: Final = 660
LAST: Final = 240
"""Ticks at the end of a trial on which it is judged."""

TROT: Final = metrics.GAITS[4]["trot"]

MI_SETS: Final = ((0.05, 0.12, 0.22, 0.29), (0.08, 0.15, 0.25, 0.28), (0.06, 0.10, 0.19, 0.27))
RATES: Final = (45.0, 30.0, 50.0)
LOADED: Final = ((0.08, 0.25), (0.08, 0.15), (0.07, 0.11))
DAMAGED: Final = (0.15, 0.08)
"""MI, update rate [Hz], MI with payload and MI with a damaged leg of a generation, in turn."""

WANTED_LIFT: Final = 0.0115
"""Lift of a foot in swing that is asked for [m]; the paper's terrain study has 12.65 mm."""

WANTED_TURN: Final = 0.2
"""Turning rate asked for at full steering [rad/s]."""

MARGIN: Final = 0.93
"""Share of the learning rates with which an oscillator under a stuck load must still stop [1]."""

MEMORY: Final = Timeline(lowered=0.0, broken=3.0, stopped=8.0, restarted=9.0, end=14.0)

STORED: Final[Mapping[str, Setting]] = {"stored": True, "phi_stored": (3.3, 3.05, 0.12)}
"""A gait that is not exact, as measured relations never are."""

COSTS: Final = ("mi_0", "mi_1", "mi_2", "mi_3", "rate", "payload_0", "payload_1", "damage",
                "memory", "turn", "blocked")  # fmt: skip
"""Names of the costs of a candidate; the search adds them up."""


def costs(candidate: Candidate, seed: int) -> tuple[float, ...]:
    """Costs of one candidate, by ``COSTS``."""
    robot, settings = built_robot(candidate), gains(candidate)
    seeds = itertools.count(100 * seed)  # another asymmetry and noise in every trial

    def walked(cost: Cost, mi: float, pace: float = 1.0, **more: Any) -> float:
        length = TRIAL_TICKS / more.get("rate", 60.0)
        what = {"robot": robot, "settings": settings, "duration": length, **more}
        record = simulate(Experiment(mi=mi, seed=next(seeds), **what))
        return cost(record, pace * wanted_speed(mi)) if record.complete else FAILED

    def of(values: tuple[Any, ...]) -> Any:
        return values[seed % len(values)]

    methods = ("apnc", "apc") if seed % 2 else ("apc", "apnc")
    rate = of(RATES)
    walks = [
        *((mi, 1.0, {"method": methods[n % 2]}) for n, mi in enumerate(of(MI_SETS))),
        (0.08, rate / 60.0, {"rate": rate}),
        *((mi, 0.8, {"conditions": "C4"}) for mi in of(LOADED)),
    ]
    formed = [walked(formation_cost, mi, pace, **more) for mi, pace, more in walks]
    damaged = walked(damage_cost, of(DAMAGED), conditions="C3")
    shared: dict[str, Any] = {"robot": robot, "settings": {**settings, **STORED}}
    return (
        *formed,
        damaged,
        memory_cost(MEMORY.experiment("apnc", next(seeds), **shared)),
        turn_cost(Experiment(seed=next(seeds), **TURNING, **shared)),
        3.0 * blocked_cost(settings),
    )


def wanted_speed(mi: float) -> float:
    """Speed asked for [m/s]: the paper's 0.08 at MI 0.15 and 0.16 at 0.4, and a little more."""
    return 0.05 + 0.28 * mi


def formation_cost(record: Record, wanted: float) -> float:
    """How far from an early, exact trot and a straight walk at ``wanted`` [m/s]."""
    error = _error(record, slice(None))
    # far from the trot for long; and at the end not well inside the tolerance
    cost = 2.0 * float(np.clip(error / np.pi, 0.0, 1.0).mean())
    cost += 1.5 * float(np.clip(error[-LAST:] - 0.2, 0.0, 1.5).mean())
    lift = float(np.ptp(record.plant["foot_position"][-LAST:, :, 2], axis=0).mean())
    cost += 0.5 * max(0.0, 1.0 - lift / WANTED_LIFT)
    return cost + walking_cost(record, wanted)


def walking_cost(record: Record, wanted: float) -> float:
    """How much slower than wanted [m/s], and how far from straight."""
    yaw = record.plant["rpy"][:, 2]
    speed = metrics.smoothed_speed(record.time, record.plant["position"], yaw)[-LAST:].mean()
    turned = np.unwrap(yaw)[[-LAST, -1]]
    cost = min(1.0, max(0.0, wanted - float(speed)) / 0.05)
    return cost + min(0.5, 0.75 * abs(float(turned[1] - turned[0])))


def damage_cost(record: Record, _: float) -> float:
    """How far from a walk on three legs in which every oscillator runs."""
    moved = np.ptp(record.controller["o1"][-LAST:], axis=0)
    stopped = float(np.clip(1.0 - moved, 0.0, 1.0).sum())
    return 0.5 * stopped + walking_cost(record, 0.06)


def memory_cost(experiment: Experiment) -> float:
    """How far S2 and S3 with a stored gait are from the paper's."""
    record = simulate(experiment)
    if not record.complete:
        return FAILED
    found, cost = judge(record, MEMORY), 0.0
    for begin, end, state in ((3.5, 8.0, "speed_s2"), (11.0, 14.0, "speed_s3")):
        error = _error(record, slice(int(begin * 60), int(end * 60)))
        cost += float(np.clip(error - 0.25, 0.0, 1.5).mean())
        cost += min(1.0, max(0.0, 0.07 - found[state]) / 0.05)
    return cost


TURNING: Final[Mapping[str, Any]] = {
    "mi": COURSE_MI,
    "duration": 12.0,
    "turn": ((0.0, 0.0), (3.0, 1.0), (7.5, -1.0)),
}


def turn_cost(experiment: Experiment) -> float:
    """How far from turning briskly to either side, with a stored gait."""
    record = simulate(experiment)
    if not record.complete:
        return FAILED
    turned = np.unwrap(record.plant["rpy"][:, 2])[[270, 449, 540, 719]]
    rates = (turned[1] - turned[0]) / 3.0, (turned[2] - turned[3]) / 3.0
    cost = 0.0
    for rate in rates:
        cost += 0.75 * min(2.0, max(0.0, 1.0 - float(rate) / WANTED_TURN))
    return cost


def blocked_cost(settings: Mapping[str, float]) -> float:
    """Rate of an oscillator without couplings whose load sticks at 0.9, over its free rate.

    Zero if it stops with learning rates a little lower, too. The rate falls towards the stop, so
    the search sees where to go.
    """
    weaker = {name: settings[name] * MARGIN for name in ("B_f", "B_s") if name in settings}
    experiment = Experiment(
        mi=COURSE_MI, duration=15.0, method="apc", settings={**settings, **weaker}
    )
    plant = _StuckSensor(experiment.description, ticks=300)
    o1 = simulate(experiment, plant=plant).controller["o1"][:, 0]
    free, stuck = o1[60:300], o1[-480:]
    if np.ptp(stuck[-240:]) < STOPPED:
        return 0.0
    return min(1.0, 0.2 + 0.5 * _turns(stuck) / max(1, _turns(free)))


class _StuckSensor:
    """A plant without a robot: no foot bears a load, until after some ticks all sensors stick."""

    fell = False

    def __init__(self, robot: RobotDescription, ticks: int) -> None:
        self.legs, self.mass = tuple(leg.name for leg in robot.legs), robot.mass
        self._load, self._left = 0.9 * robot.weight / 2.0, ticks

    def grf(self) -> Array:
        return np.full(len(self.legs), self._load if self._left < 0 else 0.0)

    def set_conditions(self, conditions: Conditions) -> None:
        pass

    def advance(self, theta_hip: Array, theta_knee: Array, duration: float) -> None:
        self._left -= 1

    def trace(self) -> Trace:
        return Trace((np.zeros(1),), lambda rows: {})


def _turns(o1: Array) -> int:
    high = o1 > o1.mean()
    return int(np.count_nonzero(~high[:-1] & high[1:]))


def _error(record: Record, part: slice) -> Array:
    c = record.controller
    error = metrics.phase_error(c["o1"][part], c["o2"][part], TROT)
    return np.asarray(np.nan_to_num(error, nan=np.pi))
