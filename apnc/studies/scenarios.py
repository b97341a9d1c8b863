"""The three states of section 3.2 end to end: a gait forms (S1), sensors break (S2), memory (S3).

Only time decides what happens to the robot; no schedule here knows what the robot does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.loop.fmu_controller import FmuController, Setting
from apnc.loop.master import Commands, run
from apnc.loop.recording import Record
from apnc.loop.walk import WalkOptions
from exudyn_models.conditions import Conditions, named_conditions
from exudyn_models.physics.plant import Plant
from exudyn_models.robot.file import load_robot
from exudyn_models.robot.model import RobotDescription

STOPPED: Final = 0.2
"""An oscillator whose o1 moves less than this, of about 1.7 in a cycle, counts as stopped [1]."""

WALKS: Final = 0.03
"""Slowest mean speed along the heading that counts as walking [m/s]."""

ROOTED: Final = 0.01
"""Fastest mean speed along the heading that counts as rocking in place [m/s]."""

SETTLING: Final = 2.0
"""Time that a broken sensor gets to stop its oscillator [s]."""


@dataclass(frozen=True)
class Timeline:
    """When what happens; times from the start of the run [s].

    Args:
        lowered: the robot, held in the air before, is set down (S1).
        broken: the sensors of the front legs stick at 0.9 (S2).
        stopped: MI is 0, the load feedback of all legs is removed (S3).
        restarted: MI is back, the feedback is not.
        end: end of the run.
        mi: modulatory input outside the stop [1].

    Raises:
        ValueError: times that do not follow each other.

    Source: section 3.2 and Fig. 9-12; 1.7 s and 20 ... 24 s are the paper's.
    """

    lowered: float = 1.7
    broken: float = 14.0
    stopped: float = 20.0
    restarted: float = 24.0
    end: float = 34.0
    mi: float = 0.15

    def __post_init__(self) -> None:
        """Check the order."""
        times = (0.0, self.lowered, self.broken, self.stopped, self.restarted, self.end)
        if list(times) != sorted(times) or self.end <= self.restarted:
            raise ValueError(f"times {times[1:]} s do not follow each other")

    def commands(self, t: float) -> Commands:
        """Commands at time ``t`` [s]."""
        return Commands(MI=0.0 if self.stopped <= t < self.restarted else self.mi)

    def conditions(self, t: float) -> Conditions:
        """Conditions of the robot at time ``t`` [s]."""
        if t < self.lowered:
            return named_conditions("S1")
        if t < self.broken:
            return named_conditions("C1")
        return named_conditions("S2" if t < self.stopped else "S3")


@dataclass(frozen=True)
class Outcome:
    """What became of the gait in each state.

    Args:
        formed: S1: strict criterion, from the set-down to the break.
        formation_time_s: S1: from the touch moment [s].
        kept: S2: every phase within 0.6 rad of the trot from the break to the stop.
        front_stopped: S2: both front oscillators rest.
        recovered: S3: strict criterion, from the restart to the end.
        recovery_time_s: S3: from the restart [s].
        in_phase: S3: all legs within 0.6 rad of each other at the end.
        speed_s1, speed_s2, speed_s3: mean speed along the heading over the last 3 s of each
            state [m/s].
        fell: the robot fell at any time.
        stored_at_s: when the couplings switched on [s]; None if never.
    """

    formed: bool
    formation_time_s: float | None
    kept: bool
    front_stopped: bool
    recovered: bool
    recovery_time_s: float | None
    in_phase: bool
    speed_s1: float
    speed_s2: float
    speed_s3: float
    fell: bool
    stored_at_s: float | None

    def as_paper_says(self, anc: bool) -> dict[str, bool]:
        """Whether S1, S2 and S3 went as in Fig. 10-12, with or without the neural couplings."""
        stands = not self.fell
        if anc:
            return {
                "S1": stands and self.formed,
                "S2": stands and self.kept and self.speed_s2 >= WALKS,
                "S3": stands and self.recovered and self.speed_s3 >= WALKS,
            }
        return {
            "S1": stands and self.formed,
            "S2": stands and self.front_stopped,
            "S3": stands and self.in_phase and abs(self.speed_s3) <= ROOTED,
        }


def run_scenario(
    fmu: Path,
    seed: int,
    anc: bool,
    timeline: Timeline | None = None,
    robot: RobotDescription | None = None,
    settings: Mapping[str, Setting] | None = None,
) -> Record:
    """Run S1, S2 and S3 in one go.

    Args:
        fmu: the controller FMU for four legs.
        seed: of the robot's asymmetry and the sensor noise.
        anc: with the neural couplings (method apnc) or without (apc).
        timeline: when what happens.
        robot: the robot, Lilibot if omitted.
        settings: parameters that differ from the preset ``lilibot``.

    Raises:
        ValueError: a setting or the FMU cannot be used.
    """
    when, body = timeline or Timeline(), robot or load_robot("lilibot")
    method = "apnc" if anc else "apc"
    options = WalkOptions(when.mi, when.end, method, seed, settings=settings or {})
    parameters = {"robot_weight": body.weight} | options.parameters()
    Ts = parameters["Ts"]
    assert isinstance(Ts, float)
    with FmuController(fmu, parameters) as controller:
        plant = Plant(body, seed, conditions=when.conditions(0.0))
        return run(plant, controller, when.end, Ts, when.commands, circumstances=when.conditions)


def judge(record: Record, timeline: Timeline | None = None) -> Outcome:
    """What became of the gait.

    Args:
        record: a complete run of ``run_scenario``.
        timeline: the one it was run with.

    Raises:
        ValueError: the run ended early.
    """
    when = timeline or Timeline()
    if not record.complete:
        raise ValueError(f"the run ended early: {record.error or 'stopped'}")
    s1 = _part(record, when.lowered, when.broken)
    s2 = _part(record, when.broken, when.stopped)
    s3 = _part(record, when.restarted, when.end)
    load = record.plant["foot_force"][s1, :, 2]
    touch = metrics.touch_moment(load, record.mass * metrics.GRAVITY)
    formation = _convergence(record, s1, touch)
    recovery = _convergence(record, s3, 0)
    settled = _part(record, when.broken + SETTLING, when.stopped)
    front = [leg for leg, name in enumerate(record.legs) if name.endswith("F")]
    front_o1 = record.controller["o1"][settled][:, front]
    roll, pitch, _ = record.plant["rpy"].T
    on = np.flatnonzero(record.controller["kappa"] > 0.0)
    return Outcome(
        formed=formation is not None,
        formation_time_s=formation,
        kept=bool((_error(record, s2, _trot(record)) <= metrics.STRICT_TOLERANCE).all()),
        front_stopped=bool((np.ptp(front_o1, axis=0) < STOPPED).all()),
        recovered=recovery is not None,
        recovery_time_s=recovery,
        in_phase=_in_phase(record, s3),
        speed_s1=_last_speed(record, when.broken),
        speed_s2=_last_speed(record, when.stopped),
        speed_s3=_last_speed(record, when.end),
        fell=metrics.fell(roll, pitch, record.plant["position"][:, 2]),
        stored_at_s=float(record.time[on[0]]) if len(on) else None,
    )


def _part(record: Record, begin: float, end: float) -> slice:
    first, last = np.searchsorted(record.time, [begin - 1e-9, end - 1e-9])
    return slice(int(first), int(last))


def _trot(record: Record) -> tuple[float, ...]:
    target = metrics.default_target(record.n_legs)
    if target is None or record.n_legs != 4:
        raise ValueError(f"the scenario is one of 4 legs, not of {record.n_legs}")
    return target


def _error(record: Record, part: slice, target: tuple[float, ...]) -> NDArray[np.float64]:
    c = record.controller
    return metrics.phase_error(c["o1"][part], c["o2"][part], target)


def _convergence(record: Record, part: slice, touch: int | None) -> float | None:
    c = record.controller
    return metrics.convergence_time(
        record.time[part], c["o1"][part], c["o2"][part], touch, _trot(record)
    )


def _in_phase(record: Record, part: slice) -> bool:
    last_second = _error(record, part, (0.0, 0.0, 0.0))[-60:]
    return bool((last_second <= metrics.STRICT_TOLERANCE).all())


def _last_speed(record: Record, end: float, span: float = 3.0) -> float:
    part = _part(record, end - span, end)
    yaw = record.plant["rpy"][:, 2]
    speed = metrics.smoothed_speed(record.time, record.plant["position"], yaw)
    return float(speed[part].mean())
