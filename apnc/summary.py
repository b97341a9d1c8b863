"""The key figures of one run, as printed, stored in summary.json and shown in the report."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from apnc import metrics
from apnc_core import __version__
from apnc_plant.signals import PLANT_SIGNALS

if TYPE_CHECKING:
    from apnc.loop.record import Record

LATE_S: Final = 10.0
"""Last part of a run whose speed and phase error are given by themselves [s]: ten strides."""

FELL_AT_ONCE_S: Final = 2.0
"""A run that fell before this did not walk: not two strides at the slowest rate [s]."""


@dataclass(frozen=True)
class Summary:
    """Key figures of one run; ``None`` where a figure is undefined for this run."""

    controller: str  # controller that walked the robot
    mi: float | tuple[tuple[float, float], ...]  # modulatory input MI asked for, or its steps
    seed: int  # of everything random in the run
    end: str  # complete, fell, diverged or interrupted
    message: str  # what broke down
    duration_s: float  # simulated time until the end
    complete: bool
    fell: bool
    path_speed_m_per_s: float | None  # mean, along the smoothed path
    turned_deg: float | None  # of the trunk to the left, over the whole run
    speed_m_per_s: float | None  # mean, along the initial heading
    distance_m: float | None  # net displacement along the initial heading
    late_speed_m_per_s: float | None  # mean of the last 10 s, along the heading
    converged: bool | None  # strict criterion; None without a target gait
    convergence_time_s: float | None  # strict criterion, from the touch moment
    convergence_time_authors_s: float | None  # their first crossing, from the touch moment
    phi_target: tuple[float, ...] | None  # phi_12, phi_13, ... of the target gait [rad]
    phi_final: tuple[float | None, ...]  # phi_12, phi_13, ... at the end, in [-pi/2, 3pi/2) [rad]
    gait: str | None  # name of the gait within 0.6 rad of the final phases
    largest_late_error_rad: float | None  # deviation from the target gait in the last 10 s
    stored_at_s: float | None  # when kappa first rose above 0
    stride_frequency_hz: float | None  # of the cycles of the oscillators
    stride_length_mm: float | None  # way of the trunk along the path in a stride
    duty_factor: dict[str, float | None]  # mean share of stance in a stride, per leg
    duty_factor_mean: float | None  # over the legs
    touch_downs_per_stride: float | None  # mean over the legs; above 1 the feet scuff
    touch_downs_by_leg: dict[str, float | None]  # mean number per stride of each foot
    foot_lift_mm: dict[str, float | None]  # in mid-swing above stance, per leg
    slip_per_stride_mm: dict[str, float | None]  # way over the ground in stance, per leg
    slip_share: dict[str, float | None]  # the same as a share of the stride length, per leg
    balance: float | None  # 1/std(roll) + 1/std(pitch) [1/rad]; larger is steadier
    coordination: float | None  # 1 / largest spread of the share of stance; larger is more even
    cost_of_transport: float | None  # energy per weight and distance
    real_time_factor: float | None  # simulated time / wall time
    fmu_share_of_wall_time: float | None
    version: str  # of this software

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionary in which every figure is finite or ``None``."""
        return asdict(self)

    def to_json(self) -> str:
        """Strict JSON text: what is undefined is ``null``."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False) + "\n"


def summarise(record: Record) -> Summary:
    """Key figures of a run that ended in whatever way, of any length including none.

    Nothing is measured of a run that diverged or has a value that is not finite; a run that fell or
    diverged has not converged. Strides, feet and balance count from the touch moment, so that the
    drop to the ground at the start is no stride; the stride length is that of the same time. Loads
    are those of the ground, not of the sensors.
    """
    sound = _sound(record)
    weight = record.mass * metrics.GRAVITY
    touch = metrics.touch_moment(sound.signals["foot_force"][..., 2], weight)
    figures = {
        "controller": record.experiment.controller_name,
        "mi": record.experiment.mi,
        "seed": record.experiment.seed,
        "end": str(record.end),
        "message": record.message,
        "duration_s": record.ended_at,
        "complete": record.complete,
        "fell": record.end == "fell",
        "real_time_factor": _ratio(record.ended_at, record.wall_s),
        "fmu_share_of_wall_time": _ratio(record.fmu_wall_s, record.wall_s),
        "version": __version__,
    }
    return Summary(**_finite(figures | _motion(sound, touch or 0) | _formation(sound, touch)))


def _motion(record: Record, begin: int) -> dict[str, Any]:
    """Speed, strides, feet, balance and cost."""
    time, plant, position = record.time, record.signals, record.signals["position"]
    late, (roll, pitch, yaw) = time >= time[-1:] - LATE_S, plant["rpy"].T
    standing = metrics.stance(plant["foot_force"][..., 2])[begin:]
    starts = metrics.cycle_starts(record.signals["o1"][begin:], record.signals["o2"][begin:])
    feet, duty = plant["foot_position"][begin:], metrics.duty_factors(standing, starts)
    distance, path = metrics.forward_distance(position, yaw), metrics.path_length(position)
    speed, turned = metrics.mean_speed(time, path), metrics.turned(yaw)
    cost = metrics.cost_of_transport(time, plant["joint_work"], record.mass, path)
    frequency = metrics.stride_frequency(starts, 1.0 / record.experiment.rate)
    pace = metrics.mean_speed(time[begin:], metrics.path_length(position[begin:]))
    stride, slips = metrics.stride_length(pace, frequency), metrics.slips(feet, standing, starts)
    touches = metrics.touch_downs_per_stride(standing, starts)

    def by_leg(values: Sequence[float | None], unit: float = 1.0) -> dict[str, float | None]:
        scaled = [None if value is None else unit * value for value in values]
        return dict(zip(record.legs, scaled, strict=True))

    return {
        "path_speed_m_per_s": speed,
        "turned_deg": None if turned is None else math.degrees(turned),
        "speed_m_per_s": metrics.mean_speed(time, distance),
        "distance_m": distance,
        "late_speed_m_per_s": _mean(metrics.smoothed_speed(time, position, yaw)[late]),
        "stride_frequency_hz": frequency,
        "stride_length_mm": None if stride is None else 1000.0 * stride,
        "duty_factor": by_leg(duty),
        "duty_factor_mean": _mean(duty),
        "touch_downs_per_stride": _mean(touches),
        "touch_downs_by_leg": by_leg(touches),
        "foot_lift_mm": by_leg(metrics.foot_lifts(feet, standing, starts), 1000.0),
        "slip_per_stride_mm": by_leg(slips, 1000.0),
        "slip_share": by_leg(slips, 1.0 / stride) if stride else dict.fromkeys(record.legs),
        "balance": metrics.balance(roll[begin:], pitch[begin:], speed),
        "coordination": metrics.coordination(standing, starts, speed),
        "cost_of_transport": cost,
    }


def _formation(record: Record, touch: int | None) -> dict[str, Any]:
    """Convergence by both criteria, final phases and the moment of storing."""
    time, o1, o2 = record.time, record.signals["o1"], record.signals["o2"]
    target = metrics.default_target(len(record.legs))
    late, broken = time >= time[-1:] - LATE_S, record.end in ("fell", "diverged")
    strict = authors = None
    error = np.full(len(time), np.nan)
    if target is not None:
        error = metrics.phase_error(o1, o2, target)
        if not broken:
            strict = metrics.settling_time(time, error, touch)
            authors = metrics.convergence_time_authors(time, o1, o2, touch, target)
    final = metrics.final_phases(o1, o2, 1.0 / record.experiment.rate)
    known = target is not None and len(time) > 0
    stored = time[record.signals["kappa"] > 0.0]
    return {
        "converged": False if broken else strict is not None if known else None,
        "convergence_time_s": strict,
        "convergence_time_authors_s": authors,
        "phi_target": target,
        "phi_final": tuple(final.tolist()),
        "gait": metrics.nearest_gait(final, metrics.STRICT_TOLERANCE),
        "largest_late_error_rad": float(error[late].max()) if len(error) else None,
        "stored_at_s": float(stored[0]) if len(stored) else None,
    }


def _sound(record: Record) -> Record:
    """The record, without samples if it diverged, fell at once or holds a value not finite."""
    fell_at_once = record.end == "fell" and record.ended_at < FELL_AT_ONCE_S
    needed = ("o1", "o2", *(signal.name for signal in PLANT_SIGNALS))
    finite = all(np.isfinite(record.signals[name]).all() for name in needed)
    return record if finite and not fell_at_once and record.end != "diverged" else record.until(0)


def _mean(values: Any) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.mean(known)) if known else None


def _ratio(value: float, by: float) -> float | None:
    return value / by if by > 0 else None


def _finite(value: Any) -> Any:
    """The same value with ``None`` for every number that is not finite."""
    if isinstance(value, dict):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, tuple):
        return tuple(_finite(entry) for entry in value)
    return None if isinstance(value, float) and not math.isfinite(value) else value
