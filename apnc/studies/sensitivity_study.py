"""How sure must a number of the robot be? Each is changed alone, and the walk is judged."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc.loop.walk import WalkOptions, walk
from apnc.studies.formation_study import fingerprint
from apnc.studies.formation_table import numbers
from apnc.studies.study import run_study, seeds_of
from apnc.studies.trial_table import Execution, Row
from apnc.summary import summarise
from build_fmu.build import host_fmu
from exudyn_models.robot.file import load_robot
from exudyn_models.robot.model import Body, RobotDescription

Change = Callable[[RobotDescription], RobotDescription]

MI_VALUES: Final = (0.08, 0.16)


def _set(part: str, field: str, value: Any) -> Change:
    """A field of servo, contact or sensor set to a value."""

    def change(robot: RobotDescription) -> RobotDescription:
        return replace(robot, **{part: replace(getattr(robot, part), **{field: value})})

    return change


def _part(part: str, field: str, factor: float) -> Change:
    """A field of servo, contact or sensor times a factor."""

    def change(robot: RobotDescription) -> RobotDescription:
        return _set(part, field, factor * getattr(getattr(robot, part), field))(robot)

    return change


def _shifted(ahead: float = 0.0, up: float = 0.0) -> Change:
    """The centre of mass of the trunk moved [m]."""

    def change(robot: RobotDescription) -> RobotDescription:
        x, y, z = robot.trunk.body.com
        body = replace(robot.trunk.body, com=(x + ahead, y, z + up))
        return replace(robot, trunk=replace(robot.trunk, body=body))

    return change


def _lighter_tibiae(moved: float) -> Change:
    """Mass moved from each tibia to its femur [kg]."""

    def heavier(body: Body, by: float) -> Body:
        return replace(body, mass=body.mass + by)

    def change(robot: RobotDescription) -> RobotDescription:
        legs = tuple(
            replace(leg, femur=heavier(leg.femur, moved), tibia=heavier(leg.tibia, -moved))
            for leg in robot.legs
        )
        return replace(robot, legs=legs)

    return change


CHANGES: Final[Mapping[str, Change]] = {
    "nothing": lambda robot: robot,
    "foot stiffness x 0.7": _part("contact", "stiffness", 0.7),
    "foot stiffness x 1.3": _part("contact", "stiffness", 1.3),
    "foot damping x 0.7": _part("contact", "damping", 0.7),
    "foot damping x 1.3": _part("contact", "damping", 1.3),
    "damping depth x 0.5": _part("contact", "damping_depth", 0.5),
    "damping depth x 2": _part("contact", "damping_depth", 2.0),
    "friction 0.5": _set("contact", "friction", 0.5),
    "friction 1.0": _set("contact", "friction", 1.0),
    "friction speed x 0.7": _part("contact", "friction_speed", 0.7),
    "friction speed x 1.5": _part("contact", "friction_speed", 1.5),
    "P x 0.8": _part("servo", "stiffness", 0.8),
    "P x 1.2": _part("servo", "stiffness", 1.2),
    "D x 0.8": _part("servo", "damping", 0.8),
    "D x 1.2": _part("servo", "damping", 1.2),
    "reflected inertia x 0.7": _part("servo", "reflected_inertia", 0.7),
    "reflected inertia x 2": _part("servo", "reflected_inertia", 2.0),
    "servo latency 5 ms": _set("servo", "latency", 0.005),
    "servo latency 16.7 ms": _set("servo", "latency", 1 / 60),
    "trunk's centre of mass 10 mm higher": _shifted(up=0.010),
    "10 mm lower": _shifted(up=-0.010),
    "5 mm further ahead": _shifted(ahead=0.005),
    "5 mm further back": _shifted(ahead=-0.005),
    "25 g from each tibia to its femur": _lighter_tibiae(0.025),
    "sensor delay x 0.7": _part("sensor", "delay", 0.7),
    "sensor delay x 1.5": _part("sensor", "delay", 1.5),
    "sensor noise x 3": _part("sensor", "noise", 3.0),
    "sensor shows the norm": _set("sensor", "component", "norm"),
}
"""What is changed, by the name it has in the table."""


@dataclass(frozen=True)
class Trial:
    """One walk of a changed robot.

    Args:
        change: name in ``CHANGES``.
        mi: modulatory input [1].
        seed: of the robot's asymmetry and the sensor noise.
        duration_s: simulated time [s].
        parameters: fingerprint of the parameters and of the unchanged robot.
    """

    change: str
    mi: float
    seed: int
    duration_s: float
    parameters: str


def run_sensitivity(
    output: Path,
    seeds: int = 3,
    changes: Sequence[str] = tuple(CHANGES),
    duration: float = 45.0,
    execution: Execution | None = None,
) -> Path:
    """Run the study and write ``sensitivity.csv`` and ``sensitivity.md``.

    Args:
        output: folder for the files, made if missing.
        seeds: trials per change and MI, seeds 0 ... seeds - 1.
        changes: names in ``CHANGES``.
        duration: simulated time of a trial [s].
        execution: how the trials are run.

    Returns:
        The table, a row per trial.

    Raises:
        ValueError: a value outside what is allowed, or a table that is there without ``resume``.
        OSError: a file cannot be written.
    """
    for name in changes:
        if name not in CHANGES:
            raise ValueError(f"change '{name}' is not one of {', '.join(CHANGES)}")
    WalkOptions(duration=duration)
    known = fingerprint()
    trials = [
        Trial(change, mi, seed, float(duration), known)
        for change in changes
        for mi in MI_VALUES
        for seed in seeds_of(seeds)
    ]
    path = output / "sensitivity.csv"
    run_study(path, trials, run_trial, sensitivity_markdown, execution)
    return path


def run_trial(trial: Trial) -> Row:
    """Walk one trial.

    Raises:
        RuntimeError: the simulation broke down.
    """
    options = WalkOptions(trial.mi, trial.duration_s, seed=trial.seed)
    robot = CHANGES[trial.change](load_robot(options.robot))
    record = walk(options, host_fmu(), robot=robot)
    if not record.complete:
        raise RuntimeError(record.error)
    summary = summarise(record, method=options.method, mi=trial.mi, seed=trial.seed)
    return asdict(trial) | {
        "convergence_time_s": summary.convergence_time_s,
        "path_speed_m_per_s": summary.path_speed_m_per_s,
        "fell": int(summary.fell),
    }


def sensitivity_markdown(rows: Sequence[Mapping[str, Any]]) -> str:
    """The table: a line per change, strict times and mean speed per MI; "-" did not form.

    Args:
        rows: rows of ``sensitivity.csv``.
    """
    mis = sorted({float(row["mi"]) for row in rows})
    head = " | ".join(f"MI {mi:.2f}: trot after [s] | speed [m/s]" for mi in mis)
    lines = [f"| change | {head} | fell |\n", "|---" * (2 * len(mis) + 2) + "|\n"]
    for change in dict.fromkeys(str(row["change"]) for row in rows):
        own = [row for row in rows if row["change"] == change]
        cells = [_cell([row for row in own if float(row["mi"]) == mi]) for mi in mis]
        fell = int(sum(numbers(own, "fell")))
        lines.append(f"| {change} | {' | '.join(cells)} | {fell}/{len(own)} |\n")
    return "".join(lines)


def _cell(rows: Sequence[Mapping[str, Any]]) -> str:
    times = [row.get("convergence_time_s") for row in rows]
    shown = ", ".join("-" if t in (None, "") else f"{float(t):.1f}" for t in times)
    speed = numbers(rows, "path_speed_m_per_s")
    return f"{shown} | {np.mean(speed):.3f}" if speed else f"{shown} | -"
