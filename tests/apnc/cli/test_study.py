"""``apnc study``: studies by name."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_line import run

from apnc.studies.registry import STUDIES


def test_studies_are_listed_with_title_and_place(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "study", "--help")
    assert code == 0
    for entry in STUDIES.values():
        (line,) = [x for x in out.splitlines() if x.split()[:1] == [entry.name]]
        assert entry.title in line and entry.section in line


def test_a_study_of_a_hexapod_names_its_robot_and_its_gait(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    code, _, err = run(
        capsys, "study", "gait", "--robot", "hexapod", "--mi", "0.08", "--trials", "1",
        "--duration", "2", "--workers", "1", "--output", "out",
    )  # fmt: skip
    assert code == 0, err
    assert "strict tripod" in Path("out/gait.md").read_text()
    claims = Path("out/claims.md").read_text()
    assert "strict tripod in every run" in claims and "trot" not in claims
    assert "phi_final_16" in Path("out/trials.csv").read_text()
    page = Path("out/report.html").read_text()
    assert "<dd>hexapod</dd>" in page and "trot" not in page.split("<main")[1].split("<script")[0]


def test_a_study_is_written_and_resumed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ("study", "mi", "--mi", "0.1, 0.2", "--controllers", "apnc", "--duration", "1")
    more = ("--trials", "1", "--workers", "1", "--series")
    code, out, err = run(capsys, *words, *more)
    assert code == 0, err
    first, second = out.splitlines()
    assert first == "2 trials, 2 complete; report: apnc-study-mi/report.html"
    assert second == "no verdict on claims about apnc: fewer than 5 seeds; raise --trials"
    folder = tmp_path / "apnc-study-mi"
    rows = [json.loads(line) for line in (folder / "trials.jsonl").read_text().splitlines()]
    assert sorted((row["mi"], row["duration"], row["controller"]) for row in rows) == [
        (0.1, 1.0, "apnc"),
        (0.2, 1.0, "apnc"),
    ]
    assert len(list((folder / "series").iterdir())) == 2
    assert "holds trials already; --resume continues them" in run(capsys, *words, *more)[2]
    before = (folder / "trials.jsonl").read_bytes()
    assert run(capsys, *words, *more, "--resume")[0] == 0
    assert (folder / "trials.jsonl").read_bytes() == before


def test_a_trial_that_ends_with_an_error_has_its_code(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    ends = ["complete", "fell", "error", "fell", "diverged"]
    rows = [
        {"end": end, "study": "rate", "controller": "apnc", "seed": n} for n, end in enumerate(ends)
    ]
    monkeypatch.setattr("apnc.studies.runner.run_study", lambda *_, **__: rows)
    code, out, _ = run(capsys, "study", "rate", "--output", str(tmp_path))
    assert code == 1
    assert out.startswith(
        "5 trials, 1 complete, 1 diverged, 1 ended with an error, 2 fell; report: "
    )
    assert "no verdict" not in out  # five seeds
