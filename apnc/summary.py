"""The key figures of one run, as printed, stored in summary.json and shown in the report."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed_version
from typing import Any

import numpy as np

from apnc import metrics
from apnc.loop.recording import Record


@dataclass(frozen=True)
class Summary:
    """Key figures of one run; ``None`` where a figure is undefined for this run.

    Args:
        method: controller that walked the robot.
        mi: modulatory input MI [1] asked for.
        seed: seed of everything random in the run.
        duration_s: simulated time [s].
        complete: False if the run was interrupted.
        fell: trunk beyond 60 deg or on the ground.
        converged: strict criterion; None if no target gait is known for this number of legs.
        convergence_time_s: strict criterion, from the touch moment [s].
        convergence_time_authors_s: the authors' first crossing, from the touch moment [s].
        phi_target: relative phases of the target gait [rad].
        phi_final: relative phases phi_12, phi_13, ... at the end [rad], in [-pi/2, 3pi/2).
        speed_m_per_s: mean forward speed along the initial heading [m/s].
        path_speed_m_per_s: mean speed along the smoothed path [m/s].
        distance_m: displacement along the initial heading [m].
        stride_frequency_hz: mean stride frequency [Hz].
        duty_factor: mean duty factor per leg name [1].
        balance: 1/std(roll) + 1/std(pitch) [1/rad].
        coordination: 1 / largest spread of the duty factor [1].
        cost_of_transport: energy per weight and distance [1].
        real_time_factor: simulated time / wall time [1].
        fmu_share_of_wall_time: share of the wall time spent in the controller [1].
        version: version of this software.
    """

    method: str
    mi: float
    seed: int
    duration_s: float
    complete: bool
    fell: bool
    converged: bool | None
    convergence_time_s: float | None
    convergence_time_authors_s: float | None
    phi_target: tuple[float, ...] | None
    phi_final: tuple[float | None, ...]
    speed_m_per_s: float | None
    path_speed_m_per_s: float | None
    distance_m: float | None
    stride_frequency_hz: float | None
    duty_factor: dict[str, float | None]
    balance: float | None
    coordination: float | None
    cost_of_transport: float | None
    real_time_factor: float | None
    fmu_share_of_wall_time: float | None
    version: str

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionary in which every figure is finite or ``None``."""
        cleaned: dict[str, Any] = _finite(asdict(self))
        return cleaned

    def to_json(self) -> str:
        """Strict JSON text: what is undefined or not finite is ``null``."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False) + "\n"


def summarise(record: Record, *, method: str, mi: float, seed: int) -> Summary:
    """Key figures of a run.

    Args:
        record: the run, finished or interrupted, of any length including none.
        method: controller that walked the robot.
        mi: modulatory input asked for [1].
        seed: seed of the run.

    Duty factors, coordination and balance count from the touch moment, so that the robot's drop
    to the ground at the start is no stride. Loads are those of the ground, not of the sensors.
    """
    target = metrics.default_target(record.n_legs)
    time, plant = record.time, record.plant
    o1, o2 = record.controller["o1"], record.controller["o2"]
    vertical = plant["foot_force"][..., 2]
    roll, pitch, yaw = plant["rpy"].T
    touch = metrics.touch_moment(vertical, record.mass * metrics.GRAVITY)
    begin = touch or 0
    standing = metrics.stance(vertical)[begin:]
    duties = metrics.duty_factors(standing)
    tick = _sample_time(record)

    def when(criterion: Callable[..., float | None]) -> float | None:
        return None if target is None else criterion(time, o1, o2, touch, target)

    strict = when(metrics.convergence_time)
    return Summary(
        method=method,
        mi=mi,
        seed=seed,
        duration_s=_simulated(record),
        complete=record.complete,
        fell=metrics.fell(roll, pitch, plant["position"][:, 2]),
        converged=None if target is None else strict is not None,
        convergence_time_s=strict,
        convergence_time_authors_s=when(metrics.convergence_time_authors),
        phi_target=target,
        phi_final=tuple(_or_none(p) for p in metrics.final_phases(o1, o2, tick)),
        speed_m_per_s=metrics.forward_speed(time, plant["position"], yaw),
        path_speed_m_per_s=metrics.path_speed(time, plant["position"]),
        distance_m=metrics.forward_distance(plant["position"], yaw),
        stride_frequency_hz=metrics.stride_frequency(standing, tick),
        duty_factor=dict(zip(record.legs, duties or [None] * record.n_legs, strict=True)),
        balance=metrics.balance(roll[begin:], pitch[begin:]),
        coordination=metrics.coordination(standing),
        cost_of_transport=metrics.cost_of_transport(
            time,
            plant["joint_work"],
            record.mass,
            metrics.path_length(plant["position"]),
        ),
        real_time_factor=_ratio(_simulated(record), record.wall_s),
        fmu_share_of_wall_time=_ratio(record.fmu_wall_s, record.wall_s),
        version=_version(),
    )


def _sample_time(record: Record) -> float:
    return float(np.median(np.diff(record.time))) if len(record) > 1 else 0.0


def _simulated(record: Record) -> float:
    # Every sample stands for one whole tick, the last one included.
    return round(len(record) * _sample_time(record), 9)


def _ratio(value: float, by: float) -> float | None:
    return value / by if by > 0 else None


def _or_none(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _version() -> str:
    try:
        return installed_version("apnc")
    except PackageNotFoundError:
        return "unknown"
