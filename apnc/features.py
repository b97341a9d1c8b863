"""What is measured of one run: printed, written to summary.json and shown in the report."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.feet import ByLeg, Feet
from apnc_core import __version__
from apnc_core.types import Array
from apnc_plant.robot.size import mean_leg_length
from apnc_plant.signals import PLANT_SIGNALS

if TYPE_CHECKING:
    from apnc.loop.record import Record

LATE_S: Final = 10.0
"""Last part of a run whose speed and phase error are given by themselves [s]: ten strides."""

FELL_AT_ONCE_S: Final = 2.0
"""A run that fell before this did not walk: not two strides at the slowest rate [s]."""


@dataclass(frozen=True)
class WalkFeatures:
    """What is measured of one run; ``None`` where a measure is undefined for this run.

    Field names are the keys of ``summary.json``. Strides and feet count from the touch moment, so
    that the drop to the ground at the start is no stride. Dictionaries are by name of the leg.

    Args:
        controller: label of the controller that walked the robot.
        mi: modulatory input MI asked for [1], or its steps ((start [s], MI), ...).
        seed: of the robot's asymmetry and the noise of its sensors.
        end: complete, fell, diverged or interrupted.
        message: what broke down; empty if nothing did.
        duration_s: simulated time until the end [s].
        complete: whether the run came to its planned end.
        fell: whether the robot fell.
        path_speed_m_per_s: mean speed along the smoothed path of the trunk [m/s].
        forward_speed_m_per_s: mean speed along the present heading since the touch moment; negative
            for a walk backwards [m/s].
        turned_deg: turn of the trunk to the left over the whole run [degrees].
        rightmost_heading_deg: least turn to the left from the first heading on the way [degrees].
        leftmost_heading_deg: largest turn to the left from the first heading on the way [degrees].
        speed_m_per_s: mean speed along the initial heading [m/s].
        distance_m: net displacement along the initial heading [m].
        late_speed_m_per_s: mean speed along the heading in the last 10 s [m/s].
        converged: whether the gait of these legs formed and held, by the strict criterion; None if
            no gait is known for these legs.
        convergence_time_s: time from the touch moment until then [s].
        convergence_time_authors_s: time from the touch moment to the first crossing of the
            threshold in the authors' evaluation [s].
        phi_target: phases phi_12, phi_13, ... of the gait of these legs [rad].
        phi_final: phases phi_12, phi_13, ... at the end, in [-pi/2, 3 pi/2) [rad].
        gait: name of the gait within 0.6 rad of the final phases.
        largest_late_error_rad: largest deviation from the gait in the last 10 s [rad].
        stored_at_s: time at which kappa first rose above 0 [s].
        stride_frequency_hz: cycles of the oscillators in a second [Hz].
        stride_length_mm: way of the trunk along its path in a stride [mm].
        duty_factor: mean share of stance in a stride [1].
        duty_factor_mean: its mean over the legs [1].
        touch_downs_per_stride: mean over the legs of the next [1].
        touch_downs_by_leg: mean number of touch-downs in a stride [1]; above 1 the foot scuffs.
        foot_lift_mm: height of the foot in mid-swing above its height in stance [mm].
        foot_lift_share: the same as a share of the leg length, femur and tibia [1].
        slip_per_stride_mm: horizontal way of the foot in the stance of a stride [mm].
        slip_share: the same as a share of the stride length [1].
        balance: 1 / std(roll) + 1 / std(pitch) [1/rad]; larger is steadier.
        coordination: 1 / largest spread of the share of stance [1]; larger is more even.
        cost_of_transport: energy of the servos over weight and path [1].
        real_time_factor: simulated time over wall time [1].
        fmu_share_of_wall_time: wall time inside the controller over that of the run [1].
        version: of this software.
    """

    controller: str
    mi: float | tuple[tuple[float, float], ...]
    seed: int
    end: str
    message: str
    duration_s: float
    complete: bool
    fell: bool
    path_speed_m_per_s: float | None
    forward_speed_m_per_s: float | None
    turned_deg: float | None
    rightmost_heading_deg: float | None
    leftmost_heading_deg: float | None
    speed_m_per_s: float | None
    distance_m: float | None
    late_speed_m_per_s: float | None
    converged: bool | None
    convergence_time_s: float | None
    convergence_time_authors_s: float | None
    phi_target: tuple[float, ...] | None
    phi_final: tuple[float | None, ...]
    gait: str | None
    largest_late_error_rad: float | None
    stored_at_s: float | None
    stride_frequency_hz: float | None
    stride_length_mm: float | None
    duty_factor: dict[str, float | None]
    duty_factor_mean: float | None
    touch_downs_per_stride: float | None
    touch_downs_by_leg: dict[str, float | None]
    foot_lift_mm: dict[str, float | None]
    foot_lift_share: dict[str, float | None]
    slip_per_stride_mm: dict[str, float | None]
    slip_share: dict[str, float | None]
    balance: float | None
    coordination: float | None
    cost_of_transport: float | None
    real_time_factor: float | None
    fmu_share_of_wall_time: float | None
    version: str

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionary in which every measure is finite or ``None``."""
        return asdict(self)

    def to_json(self) -> str:
        """Strict JSON text: what is undefined is ``null``."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False) + "\n"


def walk_features(record: Record) -> WalkFeatures:
    """Measure a run that ended in whatever way, of any length including none.

    Nothing is measured of a run that diverged or has a value that is not finite. A run that fell or
    diverged has not converged. Loads are those of the ground, not of the sensors.
    """
    sound = _sound(record)
    time, signals, legs = sound.time, sound.signals, record.legs
    weight = record.mass * metrics.GRAVITY
    touch = metrics.touch_moment(signals["foot_force"][..., 2], weight)
    walked = slice(touch or 0, None)
    position, (roll, pitch, yaw) = signals["position"], signals["rpy"].T
    distance, path = metrics.forward_distance(position, yaw), metrics.path_length(position)
    speed, turned = metrics.mean_speed(time, path), metrics.turned(yaw)
    turns = metrics.heading_range(yaw)
    ahead = metrics.smoothed_speed(time, position, yaw)
    forward = metrics.forward_speed(time[walked], position[walked], yaw[walked])
    feet, formation = Feet(sound, walked), _formation(sound, touch)
    stride = feet.stride_length
    leg_length = mean_leg_length(record.robot)
    return _finite(
        WalkFeatures(
            controller=record.experiment.controller_name,
            mi=record.experiment.mi,
            seed=record.experiment.seed,
            end=str(record.end),
            message=record.message,
            duration_s=record.ended_at,
            complete=record.complete,
            fell=record.end == "fell",
            path_speed_m_per_s=speed,
            forward_speed_m_per_s=forward,
            turned_deg=None if turned is None else math.degrees(turned),
            rightmost_heading_deg=None if turns is None else math.degrees(turns[0]),
            leftmost_heading_deg=None if turns is None else math.degrees(turns[1]),
            speed_m_per_s=metrics.mean_speed(time, distance),
            distance_m=distance,
            late_speed_m_per_s=_mean(ahead[_late(sound)].tolist()),
            converged=formation.converged,
            convergence_time_s=formation.strict,
            convergence_time_authors_s=formation.authors,
            phi_target=metrics.default_target(len(legs)),
            phi_final=tuple(formation.final.tolist()),
            gait=metrics.nearest_gait(formation.final, metrics.STRICT_TOLERANCE),
            largest_late_error_rad=formation.late_error,
            stored_at_s=_first(time[signals["kappa"] > 0.0]),
            stride_frequency_hz=feet.stride_frequency,
            stride_length_mm=None if stride is None else 1000.0 * stride,
            duty_factor=_by_leg(legs, feet.duty_factors),
            duty_factor_mean=_mean(feet.duty_factors),
            touch_downs_per_stride=_mean(feet.touch_downs),
            touch_downs_by_leg=_by_leg(legs, feet.touch_downs),
            foot_lift_mm=_by_leg(legs, feet.lifts, 1000.0),
            foot_lift_share=_by_leg(legs, feet.lifts, 1.0 / leg_length),
            slip_per_stride_mm=_by_leg(legs, feet.slips, 1000.0),
            slip_share=_by_leg(legs, feet.slips, 1.0 / stride) if stride else dict.fromkeys(legs),
            balance=metrics.balance(roll[walked], pitch[walked], speed),
            coordination=feet.coordination(speed),
            cost_of_transport=metrics.cost_of_transport(
                time, signals["joint_work"], record.mass, path
            ),
            real_time_factor=_ratio(record.ended_at, record.wall_s),
            fmu_share_of_wall_time=_ratio(record.fmu_wall_s, record.wall_s),
            version=__version__,
        )
    )


class _Formation(NamedTuple):
    """How the gait formed: fields of :class:`WalkFeatures`, and the final phases [rad]."""

    converged: bool | None
    strict: float | None
    authors: float | None
    final: Array
    late_error: float | None


def _formation(record: Record, touch: int | None) -> _Formation:
    time, o1, o2 = record.time, record.signals["o1"], record.signals["o2"]
    target = metrics.default_target(len(record.legs))
    broken = record.end in ("fell", "diverged")
    strict = authors = None
    error = np.full(len(time), np.nan)
    if target is not None:
        error = metrics.phase_error(o1, o2, target)
        if not broken:
            strict = metrics.settling_time(time, error, touch)
            authors = metrics.convergence_time_authors(time, o1, o2, touch, target)
    known = target is not None and len(time) > 0
    return _Formation(
        converged=False if broken else strict is not None if known else None,
        strict=strict,
        authors=authors,
        final=metrics.final_phases(o1, o2, 1.0 / record.experiment.rate),
        late_error=float(error[_late(record)].max()) if len(error) else None,
    )


def _late(record: Record) -> NDArray[np.bool_]:
    """Which samples are in the last part of the run, shape (T,)."""
    late: NDArray[np.bool_] = record.time >= record.time[-1:] - LATE_S
    return late


def _sound(record: Record) -> Record:
    """The record, without samples if it diverged, fell at once or holds a value not finite."""
    fell_at_once = record.end == "fell" and record.ended_at < FELL_AT_ONCE_S
    needed = ("o1", "o2", *(signal.name for signal in PLANT_SIGNALS))
    finite = all(np.isfinite(record.signals[name]).all() for name in needed)
    return record if finite and not fell_at_once and record.end != "diverged" else record.until(0)


def _by_leg(legs: Sequence[str], values: ByLeg, unit: float = 1.0) -> dict[str, float | None]:
    scaled = [None if value is None else unit * value for value in values]
    return dict(zip(legs, scaled, strict=True))


def _first(times: Array) -> float | None:
    return float(times[0]) if len(times) else None


def _mean(values: ByLeg) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.mean(known)) if known else None


def _ratio(value: float, by: float) -> float | None:
    return value / by if by > 0 else None


def _finite(found: WalkFeatures) -> WalkFeatures:
    """The same features with ``None`` for every number that is not finite."""
    values = {field.name: getattr(found, field.name) for field in fields(found)}
    return replace(found, **{name: _or_none(value) for name, value in values.items()})


def _or_none(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _or_none(entry) for key, entry in value.items()}
    if isinstance(value, tuple):
        return tuple(_or_none(entry) for entry in value)
    return None if isinstance(value, float) and not math.isfinite(value) else value
