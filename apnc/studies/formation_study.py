"""Does the gait form? Trials over MI, seeds and methods on flat ground (Fig. 4 of the paper)."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Final

import numpy as np

from apnc import metrics
from apnc.loop.recording import Record
from apnc.loop.walk import WalkOptions, walk
from apnc.studies.formation_picture import formation_svg
from apnc.studies.formation_table import formation_markdown
from apnc.studies.study import run_study, seeds_of
from apnc.studies.trial_table import Execution, Row
from apnc.summary import summarise
from apnc_core.enumerations import Method
from build_fmu.build import host_fmu
from exudyn_models.robot.file import ROBOTS

MI_VALUES: Final = tuple(round(0.04 + 0.02 * n, 2) for n in range(13))
LAST_S: Final = 10.0
"""Speed, heading and phase error are also given over this last part of a trial [s]."""


@dataclass(frozen=True)
class Trial:
    """One trial; its row depends on nothing else.

    Args:
        method: name of the controller.
        mi: modulatory input [1].
        seed: of the robot's asymmetry and the sensor noise.
        duration_s: simulated time [s].
        parameters: fingerprint of the parameters and of the robot.
    """

    method: str
    mi: float
    seed: int
    duration_s: float
    parameters: str


def fingerprint() -> str:
    """Twelve hex digits that change with any parameter of the preset or number of the robot."""
    parameters = sorted((k, repr(v)) for k, v in WalkOptions().parameters().items())
    text = (ROBOTS / "lilibot.toml").read_text(encoding="utf-8")
    return hashlib.sha256((repr(parameters) + text).encode()).hexdigest()[:12]


def run_formation(
    output: Path,
    seeds: int = 20,
    mis: Sequence[float] = MI_VALUES,
    methods: Sequence[str] = ("apnc", "apc"),
    duration: float = 45.0,
    execution: Execution | None = None,
) -> Path:
    """Run the study and write ``formation.csv``, ``formation.md`` and ``formation.svg``.

    Args:
        output: folder for the files, made if missing.
        seeds: trials per MI and method, seeds 0 ... seeds - 1.
        mis: modulatory inputs [1].
        methods: names of controllers.
        duration: simulated time of a trial [s].
        execution: how the trials are run.

    Returns:
        The table, a row per trial.

    Raises:
        ValueError: a value outside what is allowed, or a table that is there without ``resume``.
        OSError: a file cannot be written.
    """
    trials = formation_trials(seeds, mis, methods, duration)
    path = output / "formation.csv"
    rows = run_study(path, trials, run_trial, formation_markdown, execution)
    (output / "formation.svg").write_text(formation_svg(rows), encoding="utf-8")
    return path


def formation_trials(
    seeds: int, mis: Sequence[float], methods: Sequence[str], duration: float
) -> list[Trial]:
    """All trials of the grid.

    Raises:
        ValueError: no seed, MI or method, or one or a duration outside what is allowed.
    """
    if not mis or not methods:
        raise ValueError("at least one MI and one method are needed")
    for method in methods:
        for mi in mis:
            WalkOptions(mi=mi, duration=duration, method=method)
    known = fingerprint()
    return [
        Trial(str(Method[method].name), float(mi), seed, float(duration), known)
        for method in methods
        for mi in mis
        for seed in seeds_of(seeds)
    ]


def run_trial(trial: Trial) -> Row:
    """Walk one trial.

    Raises:
        RuntimeError: the simulation broke down.
    """
    options = WalkOptions(trial.mi, trial.duration_s, trial.method, trial.seed)
    record = walk(options, host_fmu())
    if not record.complete:
        raise RuntimeError(record.error)
    return asdict(trial) | measures(record, trial)


def measures(record: Record, trial: Trial) -> Row:
    """What is kept of a trial: both criteria, speeds, heading and the moment of storing."""
    summary = summarise(record, method=trial.method, mi=trial.mi, seed=trial.seed)
    on = np.flatnonzero(record.controller["kappa"] > 0.0)
    late = record.time >= record.time[-1] - LAST_S
    yaw = np.unwrap(record.plant["rpy"][:, 2])
    speed = metrics.smoothed_speed(record.time, record.plant["position"], yaw)
    o1, o2 = record.controller["o1"], record.controller["o2"]
    error = metrics.phase_error(o1, o2, metrics.default_target(record.n_legs) or ())
    duty = [value for value in summary.duty_factor.values() if value is not None]
    return {
        "converged": int(bool(summary.converged)),
        "convergence_time_s": _rounded(summary.convergence_time_s),
        "convergence_time_authors_s": _rounded(summary.convergence_time_authors_s),
        "largest_late_error_rad": _rounded(float(error[late].max())),
        "stored_at_s": _rounded(float(record.time[on[0]])) if len(on) else None,
        "fell": int(summary.fell),
        "late_speed_m_per_s": _rounded(float(speed[late].mean())),
        "forward_speed_m_per_s": _rounded(summary.speed_m_per_s),
        "path_speed_m_per_s": _rounded(summary.path_speed_m_per_s),
        "turned_deg": _rounded(float(np.degrees(yaw[-1] - yaw[0]))),
        "stride_frequency_hz": _rounded(summary.stride_frequency_hz),
        "duty_factor": _rounded(float(np.mean(duty))) if duty else None,
        "cost_of_transport": _rounded(summary.cost_of_transport),
    }


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 4)
