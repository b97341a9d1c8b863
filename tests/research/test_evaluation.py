"""Figures 4 to 6 at a size of one's own: every controller in every cell, and how sure each is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from made_up_results import made_up
from typer.testing import CliRunner

import apnc
from apnc.studies.results import STRICT, Result
from apnc.studies.runner import grid_of
from research import evaluation


def test_every_controller_runs_all_seeds_in_every_cell(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    sizes: dict[str, int] = {}

    def counted(name: str, *, trials: int, chosen: Any, resume: bool, **_: Any) -> list[Result]:
        sizes[name] = len(grid_of(name, trials, chosen=chosen))
        assert resume
        return made_up({evaluation.axis_of(name): (0.5,)}, lambda cell: {}, seeds=1, study=name)

    monkeypatch.setattr(apnc, "run_study", counted)
    words = ["--trials", "2", "--resume", "--output", str(tmp_path)]
    assert CliRunner().invoke(evaluation.app, words).exit_code == 0
    assert sizes == {"mi": 13 * 6 * 2, "rate": 8 * 5 * 2, "terrain": 7 * 5 * 2}
    assert (tmp_path / "terrain" / "terrain-cells.md").is_file()


def test_the_table_says_how_sure_shares_and_times_are() -> None:
    def figures(cell: Result) -> Result:
        return {STRICT: 2.0 if cell["seed"] else None}

    results = made_up({"roughness": (0.0, 0.5)}, figures, ("apnc", "tegotae"), 4, "terrain")
    lines = evaluation.table("terrain", results).splitlines()
    assert lines[0] == "| R | APNC | Tegotae |"
    cell = "3/4 (19 ... 99 %), 2.0 (2.0 ... 2.0) s"
    assert lines[3] == f"| 0.5 | {cell} | {cell} |"
