"""``apnc walk``: what it writes and says."""

from __future__ import annotations

import csv
import json
import os
import subprocess
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("uses a terminal and limits of the system", allow_module_level=True)

import resource

from command_line import run
from terminal import APNC, apnc
from unchecked import any_step

from apnc_plant.robot import load_robot
from apnc_plant.step import longest_step


def test_walk_writes_what_it_promises(tmp_path: Path) -> None:
    done = apnc("walk", "--duration", "3", "--json", "out/copy.json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "report: apnc-walk/report.html" in done.stdout
    folder = tmp_path / "apnc-walk"
    assert {path.name for path in folder.iterdir()} == {"summary.json", "record.csv", "report.html"}
    assert (tmp_path / "out/copy.json").read_text() == (folder / "summary.json").read_text()
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["command"] == "apnc walk --duration 3"
    assert summary["duration_s"] == 3.0
    with (folder / "record.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 180
    assert float(rows[60]["time"]) == pytest.approx(1.0)
    assert {"RF.o1", "phi12", "kappa", "position.x", "LH.foot_force.z"} <= set(rows[0])


def test_same_seed_same_record_other_seed_other_record(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, seed in (("a", "1"), ("c", "2")):
        run(capsys, "walk", "--duration", "2", "--seed", seed, "--output", name)
    apnc("walk", "--duration", "2", "--seed", "1", "--output", "b", cwd=tmp_path)
    a, b, c = ((tmp_path / name / "record.csv").read_bytes() for name in "abc")
    assert a == b
    assert a != c


def test_a_fall_is_said_and_has_its_own_code(tmp_path: Path) -> None:
    words = ("--duration", "9", "--slope", "60", "--condition", "C4")  # with its load on top
    done = apnc("walk", *words, cwd=tmp_path)
    assert done.returncode == 1, done.stderr
    summary = json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())
    assert summary["end"] == "fell" and summary["duration_s"] < 9.0
    said = f"fell at {summary['duration_s']:.2f} s; what was recorded is in apnc-walk"
    assert said in done.stderr
    assert "fell" in done.stdout


@pytest.mark.parametrize("engine", ["compiled", "exudyn"])
@pytest.mark.parametrize("step", ["0.016", "0.0083"])
def test_a_run_that_diverges_is_not_interrupted_or_a_fall_and_shows_no_huge_numbers(
    engine: str,
    step: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    any_step(monkeypatch)
    code, out, err = run(
        capsys, "walk", "--step", step, "--engine", engine, "--duration", "9"
    )  # fmt: skip
    assert code == 1, err
    assert "diverged at" in err and "interrupted" not in err + out
    assert "fell" not in err + out
    assert "e+" not in out
    summary = json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())
    assert summary["end"] == "diverged" and not summary["fell"]
    assert summary["message"].endswith(f"with integration steps of {step} s")


@pytest.mark.parametrize("step", ["0.0042", "0.0083", "0.01666"])
def test_a_step_that_is_too_long_is_refused_in_one_line(
    step: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, "walk", "--step", step)
    assert (code, out) == (2, "")
    line = (
        f"apnc: step = {step} s is too long for the servos and feet of robot 'lilibot'; allowed: "
    )
    assert err.startswith(line) and err.endswith(" s and less\n")
    longest = longest_step(load_robot("lilibot"))
    assert 0.99 * longest < float(err.removeprefix(line).split()[0]) <= longest
    assert not list(tmp_path.iterdir())


def test_a_walk_without_an_output_replaces_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "apnc-walk").mkdir()  # an empty folder is no walk
    words = ("walk", "--duration", "0.5")
    for folder in ("apnc-walk", "apnc-walk-2", "apnc-walk-3"):
        assert run(capsys, *words)[1].splitlines()[-1] == f"report: {folder}/report.html"
    first = (tmp_path / "apnc-walk" / "summary.json").read_bytes()
    assert run(capsys, *words, "--output", "apnc-walk-2", "--mi", "0.2")[0] == 0
    assert (tmp_path / "apnc-walk" / "summary.json").read_bytes() == first
    assert '"mi": 0.2' in (tmp_path / "apnc-walk-2" / "summary.json").read_text()
    assert len(list(tmp_path.iterdir())) == 3


def test_a_full_disk_names_the_file_and_leaves_the_older_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(capsys, "walk", "--duration", "1")[0] == 0
    folder = tmp_path / "apnc-walk"
    before = {path.name: path.read_bytes() for path in folder.iterdir()}

    def little_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (600_000, 600_000))

    done = subprocess.run(
        [*APNC, "walk", "--engine", "compiled", "--duration", "25", "--output", "apnc-walk"],
        cwd=tmp_path, capture_output=True, text=True, check=False, preexec_fn=little_room,
    )  # fmt: skip
    assert done.returncode == 2
    assert "apnc-walk/record.csv" in done.stderr.splitlines()[-1]
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_walk_refuses_fmi_3_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    run(capsys, "build", "--platform", "host", "--fmi", "3")
    code, _, err = run(capsys, "walk", "--fmu", "Apnc.fmu", "--duration", "1")
    assert code == 2 and "Apnc.fmu: FMI 3.0; a walk takes FMI 2.0" in err
