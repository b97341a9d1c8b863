"""What the model's own studies share: seeds, the controller built once, a table and its text."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from apnc.studies.trial_table import Execution, Row, run_trials
from build_fmu.build import host_fmu


def seeds_of(trials: int) -> range:
    """Seeds of so many trials per cell of a grid.

    Raises:
        ValueError: fewer than one trial.
    """
    if trials < 1:
        raise ValueError(f"trials = {trials} is not 1 or more")
    return range(trials)


def run_study(
    path: Path,
    trials: Sequence[Any],
    work: Callable[[Any], Row],
    markdown: Callable[[Sequence[Row]], str],
    execution: Execution | None = None,
) -> list[Row]:
    """Run the trials into a CSV table, and write its text beside it.

    Args:
        path: the table; the text has the same name and ends in ``.md``.
        trials, work, execution: as for ``run_trials``.
        markdown: makes the text of the rows.

    Returns:
        The rows as text.

    Raises:
        ValueError: no trial, or a table that is there without ``resume``.
        OSError: a file cannot be written.
    """
    host_fmu()  # built once here, not by every process at the same time
    rows = run_trials(trials, work, path, execution)
    path.with_suffix(".md").write_text(markdown(rows), encoding="utf-8")
    return rows
