"""What became of the gait in each of the states S1 to S3."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from apnc import metrics
from apnc.loop.record import End, Record
from apnc.studies.results import Result
from apnc.studies.states.timeline import TIMELINE, Timeline
from apnc_plant.robot.leg_names import by_place
from apnc_plant.robot.size import times_longer

STOPPED: Final = 0.2
"""Range of o1 below which an oscillator counts as stopped. It is about 1.7 in a cycle [1]."""

WALKS: Final = 0.03
"""Slowest mean speed along the heading that counts as walking, for legs of Lilibot [m/s]."""

ROOTED: Final = 0.01
"""Fastest mean speed along the heading that counts as rocking in place, as ``WALKS`` [m/s]."""

SETTLING: Final = 2.0
"""Time after the break in which a front oscillator may still move [s]."""

LAST: Final = 3.0
"""Time at the end of a state over which its speed is averaged [s]."""


AROUND: Final = 2.0
"""Time before the couplings switch on, and before the break, over which gamma is averaged [s]."""


def measure(record: Record) -> Result:
    """The measures of ``judge``, and whether each state went as the paper says.

    In a run that is not complete no state went as the paper says.
    """
    if record.complete and record.ended_at >= TIMELINE.end:
        found = judge(record)
        faster = math.sqrt(times_longer(record.robot))
        found |= as_paper_says(found, record.experiment.controller_name, faster)
    else:
        found = {"S1": False, "S2": False, "S3": False}
    return {f"state_{name}": value for name, value in found.items()} | {
        "state_fell": record.end is End.fell
    }


def as_paper_says(found: Result, controller: str, faster: float = 1.0) -> Result:
    """Whether S1, S2 and S3 went as in Fig. 10-12.

    ``apc`` is judged as the controller without couplings, which must lose the gait. All others are
    judged as the one with couplings, which must keep and recover it.

    Args:
        found: what :func:`judge` returns.
        controller: label of the controller.
        faster: speeds of the robot over those of Lilibot, the root of the lengths of their legs.
    """
    walks, rooted = WALKS * faster, ROOTED * faster
    s2 = found["kept"] and found["speed_s2"] >= walks
    s3 = found["recovered"] and found["speed_s3"] >= walks
    if controller == "apc":
        s2, s3 = found["front_stopped"], found["in_phase"] and abs(found["speed_s3"]) <= rooted
    return {"S1": found["formed"], "S2": s2, "S3": s3}


def judge(record: Record, when: Timeline = TIMELINE) -> Result:
    """What became of the gait in a complete run along a timeline.

    Returns:
        ``formed``: S1: strict criterion, from the set-down to the break;
        ``formation_time_s``: S1: from the touch moment [s];
        ``kept``: S2: every phase within 0.6 rad of the gait from the break to the stop;
        ``front_stopped``: S2: both front oscillators rest;
        ``recovered``: S3: strict criterion, from the restart to the end;
        ``recovery_time_s``: S3: from the restart [s];
        ``in_phase``: S3: all legs within 0.6 rad of each other in the last second;
        ``speed_s1``, ``speed_s2``, ``speed_s3``: mean speed along the heading over the last 3 s of
        each state [m/s];
        ``stored_at_s``: when the couplings switched on [s], None if never;
        ``gamma_before``, ``gamma_after``: mean gain of all legs in the two seconds before that and
        in the last two of S1 [1], None unless they switched on between these.
    """
    c, time, n_legs = record.signals, record.time, len(record.legs)
    gait = metrics.default_target(n_legs)
    if gait is None:
        raise ValueError(f"no gait is known for {n_legs} legs")

    def part(begin: float, end: float) -> slice:
        first, last = np.searchsorted(time, [begin - 1e-9, end - 1e-9])
        return slice(int(first), int(last))

    def converged(where: slice, touch: int | None) -> float | None:
        o1, o2 = c["o1"][where], c["o2"][where]
        return metrics.convergence_time(time[where], o1, o2, touch, gait)

    def stays(where: slice, gait: tuple[float, ...], last: int = 0) -> bool:
        error = metrics.phase_error(c["o1"][where], c["o2"][where], gait)[-last:]
        return bool((error <= metrics.STRICT_TOLERANCE).all())

    s1, s2 = part(when.lowered, when.broken), part(when.broken, when.stopped)
    s3, late_s2 = part(when.restarted, when.end), part(when.broken + SETTLING, when.stopped)
    touch = metrics.touch_moment(
        record.signals["foot_force"][s1, :, 2], record.mass * metrics.GRAVITY
    )
    formation, recovery = converged(s1, touch), converged(s3, 0)
    places = by_place(record.legs)
    front = [record.legs.index(places[f"{side} front"]) for side in ("right", "left")]
    moved = np.ptp(c["o1"][late_s2][:, front], axis=0)
    speed = metrics.smoothed_speed(time, record.signals["position"], record.signals["rpy"][:, 2])
    ends = {"speed_s1": when.broken, "speed_s2": when.stopped, "speed_s3": when.end}
    stored = time[c["kappa"] > 0.0]
    return {
        "formed": formation is not None,
        "formation_time_s": formation,
        "kept": stays(s2, gait),
        "front_stopped": bool((moved < STOPPED).all()),
        "recovered": recovery is not None,
        "recovery_time_s": recovery,
        "in_phase": stays(s3, (0.0,) * (n_legs - 1), last=round(record.experiment.rate)),
        **{name: float(speed[part(end - LAST, end)].mean()) for name, end in ends.items()},
        "stored_at_s": float(stored[0]) if len(stored) else None,
        **_gamma(record, float(stored[0]) if len(stored) else math.inf, when),
    }


def _gamma(record: Record, stored: float, when: Timeline) -> Result:
    if not when.lowered + AROUND <= stored <= when.broken - AROUND:
        return {"gamma_before": None, "gamma_after": None}
    gamma, time = record.signals["gamma"], record.time

    def mean(end: float) -> float:
        return float(gamma[(time >= end - AROUND) & (time < end)].mean())

    return {"gamma_before": mean(stored), "gamma_after": mean(when.broken)}
