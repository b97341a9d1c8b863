"""The report of a study: what was asked for, what was run, what failed."""

from __future__ import annotations

from pathlib import Path

import pytest
from browser import console_lines, look, needs_browser

import apnc_core
from apnc.studies import report
from apnc.studies.registry import STUDIES
from apnc.studies.results import AUTHORS, STRICT, Result
from apnc.studies.runner import grid_of
from apnc.studies.study import Trial, load


def results_of(grid: list[Trial]) -> list[Result]:
    """Results of trials that nobody ran: APNC converges first."""
    figures = {"duty_factor_mean": 0.6, "stride_frequency_hz": 1.5, "path_speed_m_per_s": 0.1}
    end = {"fell": False, "version": "9.9", "end": "complete", "error": ""}
    times = {"apnc": 2.0, "tegotae": 9.0, "tegotae_best": 8.0}
    return [
        {"study": t.study, "key": t.id.key, **t.cell, **figures, **end}
        | dict.fromkeys((STRICT, AUTHORS), times.get(t.cell["controller"], 20.0))
        for t in grid
    ]


def write(tmp_path: Path, grid: list[Trial], results: list[Result]) -> str:
    for name, put in report.files_of(grid, results, 90.0, scenes=False).items():
        put(tmp_path / name)
    return (tmp_path / "report.html").read_text()


@pytest.fixture(scope="module")
def grid() -> list[Trial]:
    return grid_of("mi", 6, chosen={"mi": [0.08, 0.16, 0.24]})


def test_the_head_says_what_was_run(tmp_path: Path, grid: list[Trial]) -> None:
    page = write(tmp_path, grid, results_of(grid))
    for text in (
        "lilibot",
        "45 s",
        "Fig. 4, S4, S5",
        "APNC; APC alone; Tegotae gamma_tegotae=0.015; Tegotae (best) gamma_tegotae=",
        "; phase resetting (best) grf_reset=",
        "108 of 108",
        "within 0.6 rad of the gait",
        "first below 2.8 rad",
        "108, 4860 s simulated in 1.5 min",
        f"versions: apnc {apnc_core.__version__}, python ",
        "exudyn ",
        "commit: ",
    ):
        assert text in page, text
    assert "not run" not in page and "did not come to their end" not in page


def test_the_report_shows_claims(tmp_path: Path, grid: list[Trial]) -> None:
    page = write(tmp_path, grid, results_of(grid))
    assert '<td class="reproduced">reproduced</td>' in page
    text = (tmp_path / "claims.md").read_text()
    line = next(line for line in text.splitlines() if "APNC converges faster than Tegotae" in line)
    assert line.startswith(
        "| APNC converges faster than Tegotae | 3.1.1, Fig. 4 | strict: APNC 2.0"
    )
    assert line.endswith(" | **reproduced** |")
    assert "- commit: " in text
    assert (tmp_path / "mi.md").read_text().startswith("| controller | MI | gait kept, strict")


def test_what_was_measured_is_a_table() -> None:
    text = (
        "strict: APNC 3.0 (1.5 ... 4.1) s, n = 6 against Tegotae -, n = 0 of 6, faster in 3 of 3 "
        "cells, p = 1, r = 0.00; APNC 3.0 s, n = 6 against Tegotae (best) -, n = 0, p = 1; "
        "authors': 0.8 (0.6 ... 0.9) s, success 6/6 (54 ... 100 %)"
    )
    assert report.statements(text) == [
        (
            "strict",
            ["APNC 3.0 (1.5 ... 4.1) s, n = 6", "against Tegotae -, n = 0 of 6"],
            ["faster in 3 of 3 cells", "p = 1", "r = 0.00"],
        ),
        ("strict", ["APNC 3.0 s, n = 6", "against Tegotae (best) -, n = 0"], ["p = 1"]),
        ("authors'", ["0.8 (0.6 ... 0.9) s"], ["success 6/6 (54 ... 100 %)"]),
    ]
    assert report.statements("too few") == [("", ["too few"], [])]


def test_no_verdict_says_how_many_seeds_it_needs(tmp_path: Path) -> None:
    few = grid_of("mi", 2, chosen={"mi": [0.08, 0.16]})
    page = write(tmp_path, few, results_of(few))
    assert "no verdict<small>needs 5 seeds of each controller, has 2</small>" in page
    enough = grid_of("mi", 12, chosen={"mi": [0.08, 0.16, 0.24]})
    page = write(tmp_path, enough, results_of(enough))
    assert "needs 5 seeds" not in page


def test_aims_are_reached_or_not_and_are_not_claims_of_the_paper(tmp_path: Path) -> None:
    aims = grid_of("gait", 6, chosen={"mi": [0.08, 0.16]})
    page = write(tmp_path, aims, results_of(aims))
    assert "aimed at" in page and "reached?" in page and ">reached</td>" in page
    assert "paper says" not in page and ">reproduced</td>" not in page


def test_a_method_that_was_not_run_is_said(tmp_path: Path) -> None:
    few = grid_of("mi", 1, ["apnc", "tegotae"], {"mi": [0.08]})
    page = write(tmp_path, few, results_of(few))
    assert "; not run: APC alone, Tegotae (best), phase resetting, phase resetting (best)" in page
    assert "not run: phase_reset, phase_reset_best" in page  # the claim on it


def test_trials_that_failed_are_listed_with_their_command(
    tmp_path: Path, grid: list[Trial]
) -> None:
    results = results_of(grid)
    results[0] |= {"end": "fell", "fell": True}
    results[1] |= {"end": "error", "error": "FmuError: <moo>"}
    page = write(tmp_path, grid, results)
    assert "2 trials did not come to their end" in page
    first, second = (trial.experiment.command() for trial in grid[:2])
    assert f"<li>fell: <code>{first}</code></li>" in page
    assert f"<li>FmuError: &lt;moo&gt;: <code>{second}</code></li>" in page


def test_a_page_needs_nothing_from_elsewhere(tmp_path: Path, grid: list[Trial]) -> None:
    page = write(tmp_path, grid, results_of(grid))
    assert "default-src 'none'" in page and "<script src" not in page


def test_a_stopped_study_with_no_result_has_a_report(tmp_path: Path, grid: list[Trial]) -> None:
    assert "0, 0 s simulated" in write(tmp_path, grid, [])
    assert (tmp_path / "trials.csv").read_text() == "\n"


def test_scenes_are_drawn_when_all_is_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trials = grid_of("damage", 1, robot="hexapod")
    study = load(STUDIES["damage"])
    asked: list[str] = []
    object.__setattr__(study, "scenes", lambda robot: asked.append(robot) or [])
    try:
        report.files_of(trials, results_of(trials), 1.0, scenes=False)
        assert asked == []
        report.files_of(trials, results_of(trials), 1.0, scenes=True)
        assert asked == ["hexapod"]
    finally:
        object.__setattr__(study, "scenes", lambda robot: [])


@needs_browser
def test_a_report_draws_in_a_browser(tmp_path: Path, grid: list[Trial]) -> None:
    write(tmp_path, grid, results_of(grid))
    draw = "<script>window.apncReady = () => apnc.drawAll() || true;</script>"
    seen, log = look(tmp_path / "report.html", tmp_path, draw)
    assert seen["errors"] == [] and console_lines(log) == []
    keys = (STRICT, AUTHORS, "duty_factor_mean", "path_speed_m_per_s")
    assert set(seen["plots"]) == {f"plot-mi-{key}" for key in keys}
    assert all(drawn > 0 for drawn in seen["plots"].values())
