"""States S1 to S3 with and without the neural couplings, over seeds (Fig. 9-12 of the paper)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc.studies.formation_study import fingerprint
from apnc.studies.formation_table import numbers, success_interval
from apnc.studies.memory_picture import memory_svg
from apnc.studies.scenarios import judge, run_scenario
from apnc.studies.study import run_study, seeds_of
from apnc.studies.trial_table import Execution, Row
from build_fmu.build import host_fmu

STATES: Final = ("S1", "S2", "S3")
_MEANING: Final = {
    ("S1", 1): "the gait forms and lasts to the break",
    ("S2", 1): "keeps the trot at every moment and walks, front sensors stuck",
    ("S3", 1): "recovers the stored gait from rest without feedback, and walks",
    ("S1", 0): "the gait forms and lasts to the break",
    ("S2", 0): "front oscillators stop",
    ("S3", 0): "rocks in place, legs in phase",
}


@dataclass(frozen=True)
class MemoryTrial:
    """One run through S1, S2 and S3.

    Args:
        anc: with the neural couplings, 1, or without, 0.
        seed: of the robot's asymmetry and the sensor noise.
        parameters: fingerprint of the parameters and of the robot.
    """

    anc: int
    seed: int
    parameters: str


def run_memory(output: Path, seeds: int = 20, execution: Execution | None = None) -> Path:
    """Run the study and write ``memory.csv``, ``memory.md`` and, of seed 0, ``memory.svg``.

    Args:
        output: folder for the files, made if missing.
        seeds: trials with and without couplings, seeds 0 ... seeds - 1.
        execution: how the trials are run.

    Returns:
        The table, a row per trial.

    Raises:
        ValueError: a value outside what is allowed, or a table that is there without ``resume``.
        OSError: a file cannot be written.
    """
    known = fingerprint()
    trials = [MemoryTrial(anc, seed, known) for anc in (1, 0) for seed in seeds_of(seeds)]
    path, how = output / "memory.csv", execution or Execution()
    run_study(path, trials, run_trial, memory_markdown, how)
    if not how.stop():
        fmu = host_fmu()
        picture = memory_svg(run_scenario(fmu, 0, True), run_scenario(fmu, 0, False))
        (output / "memory.svg").write_text(picture, encoding="utf-8")
    return path


def run_trial(trial: MemoryTrial) -> Row:
    """Run one trial.

    Raises:
        ValueError: the simulation broke down.
    """
    outcome = judge(run_scenario(host_fmu(), trial.seed, bool(trial.anc)))
    as_paper = outcome.as_paper_says(bool(trial.anc))
    row = asdict(trial) | {state: int(as_paper[state]) for state in STATES}
    for name, value in asdict(outcome).items():
        if isinstance(value, bool):
            row[name] = int(value)
        else:
            row[name] = None if value is None else round(value, 4)
    return row


def memory_markdown(rows: Sequence[Mapping[str, Any]]) -> str:
    """The table: success per state with its exact 95 % interval, times and speeds.

    Args:
        rows: rows of ``memory.csv``.
    """
    lines = [
        "| couplings | state | as the paper says | success | 95 % interval | time [s], median "
        "(longest) | speed [m/s], median (range) |\n|---|---|---|---|---|---|---|\n"
    ]
    for anc, label in ((1, "with ANC"), (0, "without")):
        members = [row for row in rows if int(row["anc"]) == anc]
        if members:
            lines += [_line(label, anc, state, members) for state in STATES]
    return "".join(lines)


def _line(label: str, anc: int, state: str, rows: list[Mapping[str, Any]]) -> str:
    good = int(sum(numbers(rows, state)))
    low, high = success_interval(good, len(rows))
    speed = numbers(rows, f"speed_{state.lower()}")
    duration = {"S1": "formation_time_s", "S3": "recovery_time_s"}.get(state, "")
    times = numbers(rows, duration) if duration else []
    when = f"{np.median(times):.1f} ({max(times):.1f})" if times else "-"
    pace = f"{np.median(speed):.3f} ({min(speed):.3f} ... {max(speed):.3f})" if speed else "-"
    entries = (label, state, _MEANING[state, anc], f"{good}/{len(rows)}")
    return f"| {' | '.join(entries)} | {100 * low:.0f} ... {100 * high:.0f} % | {when} | {pace} |\n"
