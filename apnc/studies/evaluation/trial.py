"""One trial: a pure function of its configuration and seed."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, Final

import numpy as np

import apnc_core
from apnc.loop.fmu_controller import FmuController, Setting
from apnc.loop.master import Commands, run
from apnc.loop.recording import Record, write_csv
from apnc.studies.scenarios import judge, run_scenario
from apnc.summary import summarise
from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_core.presets import preset
from apnc_core.schema import Causality
from apnc_core.variables import rows
from build_fmu.build import host_fmu
from exudyn_models.conditions import named_conditions
from exudyn_models.ground import Ground
from exudyn_models.physics.plant import Plant
from exudyn_models.robot.file import load_robot

Row = dict[str, Any]


@dataclass(frozen=True)
class Trial:
    """Configuration of one trial.

    Args:
        study: name of the study it belongs to.
        method: name of the controller, see ``Method``.
        mi: modulatory input.
        seed: of the robot's asymmetry, the sensor noise and the ground.
        duration: simulated time [s].
        rate: update rate of the controller [Hz].
        roughness: R of the ground, 0 ... 1.
        condition: name of the robot's condition, see ``CONDITIONS``.
        course: name of the commands over time, see ``COURSES``, or ``STATES``.
    """

    study: str
    method: str
    mi: float
    seed: int
    duration: float = 45.0
    rate: float = 60.0
    roughness: float = 0.0
    condition: str = "C1"
    course: str = "straight"

    @property
    def key(self) -> str:
        """Identity of the trial, the same on every machine."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()[:16]


CONFIGURATION: Final = tuple(f.name for f in fields(Trial))

Course = Callable[[float, float], Commands]


def _straight(t: float, mi: float) -> Commands:
    return Commands(MI=mi)


SPEED_COURSE: Final = ((0.0, 0.15), (25.0, 0.4), (40.0, 0.15))
"""Start time [s] and MI of every leg of the course of section 3.3, Fig. 13."""

TURN_COURSE: Final = ((0.0, 0.0), (20.0, -1.0), (35.0, 1.0), (50.0, 0.0))
"""Start time [s] and steering of every leg of the course of section 3.3, Fig. 14."""


def _at(course: tuple[tuple[float, float], ...], t: float) -> float:
    return next(value for start, value in reversed(course) if t >= start)


def _speeds(t: float, mi: float) -> Commands:
    return Commands(MI=_at(SPEED_COURSE, t))


def _turns(t: float, mi: float) -> Commands:
    return Commands(MI=mi, turn=_at(TURN_COURSE, t))


COURSES: Final[Mapping[str, Course]] = {
    "straight": _straight,
    "speeds": _speeds,
    "turns": _turns,
}
STATES: Final = "states"
"""Course of section 3.2: forms (S1), sensors break (S2), reset without feedback (S3)."""


def parameters(trial: Trial) -> dict[str, Setting]:
    """Parameters of the FMU in this trial: the default preset, the method and the rate."""
    chosen: Parameters = preset("lilibot")
    values: dict[str, Setting] = {
        v.name: getattr(chosen, v.name) for v in rows(Causality.parameter) if v.name != "phi_stored"
    }
    robot = load_robot("lilibot")
    values |= {
        "method": int(Method[trial.method]),
        "Ts": 1.0 / trial.rate,
        "robot_weight": robot.weight,
    }
    return values


def parameter_hash(trial: Trial) -> str:
    """Short hash of the parameters that the trials of a study share, to tell presets apart."""
    shared = {k: v for k, v in parameters(trial).items() if k not in ("method", "Ts")}
    text = json.dumps(shared, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def simulate(trial: Trial) -> Record:
    """Run the trial and return its record."""
    if trial.course == STATES:
        return run_scenario(host_fmu(), trial.seed, anc=trial.method == "apnc")
    course = COURSES[trial.course]
    ground = Ground(roughness=trial.roughness, seed=trial.seed)
    plant = Plant(
        load_robot("lilibot"),
        trial.seed,
        ground=ground,
        conditions=named_conditions(trial.condition),
    )
    with FmuController(host_fmu(), parameters(trial)) as controller:
        return run(
            plant, controller, trial.duration, 1.0 / trial.rate, lambda t: course(t, trial.mi)
        )


def row_of(trial: Trial, record: Record) -> Row:
    """Configuration and metrics of a finished trial, flat."""
    figures = summarise(record, method=trial.method, mi=trial.mi, seed=trial.seed).to_dict()
    duty = [value for value in figures.pop("duty_factor").values() if value is not None]
    phases = figures.pop("phi_final")
    for name in ("method", "mi", "seed", "duration_s", "phi_target", "real_time_factor"):
        figures.pop(name)
    figures.pop("fmu_share_of_wall_time")
    return {
        "key": trial.key,
        **asdict(trial),
        **figures,
        "duty_factor_mean": float(np.mean(duty)) if duty else None,
        **{f"phi_final_1{k}": phase for k, phase in enumerate(phases, start=2)},
        **_course_figures(trial, record),
        "parameters": parameter_hash(trial),
        "error": record.error,
    }


def _course_figures(trial: Trial, record: Record) -> Row:
    if trial.course == STATES:
        outcome = judge(record)
        as_paper = outcome.as_paper_says(trial.method == "apnc")
        return {f"state_{name}": value for name, value in (asdict(outcome) | as_paper).items()}
    if trial.course == "speeds":
        return {
            f"speed_leg_{i}": _speed_between(record, begin, end)
            for i, (begin, end) in enumerate(_legs_of(SPEED_COURSE, trial.duration), start=1)
        }
    if trial.course == "turns":
        return {
            f"yaw_rate_leg_{i}": _yaw_rate_between(record, begin, end)
            for i, (begin, end) in enumerate(_legs_of(TURN_COURSE, trial.duration), start=1)
        }
    return {}


def _legs_of(course: tuple[tuple[float, float], ...], end: float) -> list[tuple[float, float]]:
    """Begin and end of every leg, without the 5 s in which the robot follows a new command."""
    starts = [start for start, _ in course]
    return [(a + 5.0, b) for a, b in zip(starts, [*starts[1:], end], strict=True)]


def _speed_between(record: Record, begin: float, end: float) -> float | None:
    inside = (record.time >= begin) & (record.time < end)
    if np.count_nonzero(inside) < 2:
        return None
    place = record.plant["position"][inside, :2]
    return float(np.linalg.norm(place[-1] - place[0]) / (end - begin))


def _yaw_rate_between(record: Record, begin: float, end: float) -> float | None:
    inside = (record.time >= begin) & (record.time < end)
    if np.count_nonzero(inside) < 2:
        return None
    yaw = np.unwrap(record.plant["rpy"][inside, 2])
    return float((yaw[-1] - yaw[0]) / (end - begin))


def run_trial(trial: Trial, series: Path | None = None) -> Row:
    """Run a trial; one that raises becomes a row with its error.

    Args:
        trial: the configuration.
        series: folder for the time series, or None to keep none.
    """
    try:
        record = simulate(trial)
        if series is not None:
            write_csv(record, series / f"{trial.key}.csv")
        return row_of(trial, record)
    except Exception as error:
        text = f"{type(error).__name__}: {error}"
        empty = {"version": apnc_core.__version__, "converged": False, "fell": None}
        return {"key": trial.key, **asdict(trial), **empty, "error": " ".join(text.split())}


def finite(value: Any) -> bool:
    """Whether a cell of a row is a number that statistics may use."""
    return isinstance(value, int | float) and math.isfinite(value)
