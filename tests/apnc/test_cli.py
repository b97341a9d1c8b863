"""The command line as a person uses it, in processes of its own."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

APNC = [sys.executable, "-m", "apnc"]


def apnc(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*APNC, *arguments], cwd=cwd, capture_output=True, text=True, check=False, timeout=300
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["walk", "--method", "cow"], "method 'cow' is not one of apnc, apc, tegotae, phase_reset"),
        (["walk", "--duration", "-3"], "duration = -3.0 s is not a positive time"),
        (["walk", "--duration", "nan"], "duration = nan s is not a positive time"),
        (["walk", "--mi", "7"], "mi = 7.0 is not in 0 ... 1"),
        (["walk", "--mi", "fast"], "'--mi'"),
        (["walk", "--seed", "-1"], "seed = -1 is negative"),
        (["walk", "--preset", "cow"], "preset 'cow' is not one of lilibot, paper"),
        (["walk", "--set", "cow=1"], "parameter 'cow' is not one of Ts, robot_weight, F_max"),
        (["walk", "--set", "xi=moo"], "xi = 'moo' is not a number"),
        (["walk", "--set", "xi=7"], "xi = 7 is out of range: 0 ... 1 is allowed"),
        (
            ["walk", "--set", "kappa_rule=never"],
            "kappa_rule = 'never' is not one of armed, printed",
        ),
        (["walk", "--robot", "cow"], "robot 'cow'"),
        (["walk", "--fmu", "no.fmu"], "no.fmu: no such file"),
        (["walk", "--fmu", "text.fmu"], "text.fmu: not an FMU"),
        (["walk", "--output", "text.fmu/x"], "output folder text.fmu/x cannot be written"),
        (["walk", "--json", "."], "file . is a folder"),
        (["info", "text.fmu"], "text.fmu: not an FMU"),
        (["build", "--legs", "1"], "legs = 1 is not in 2 ... 64"),
        (["build", "--platform", "vax"], "platform 'vax' is not one of"),
        (["moo"], "moo"),
        (["walk", "--moo"], "--moo"),
    ],
)
def test_bad_use_is_one_line_and_code_2(arguments: list[str], words: str, tmp_path: Path) -> None:
    (tmp_path / "text.fmu").write_text("no zip")
    done = apnc(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert done.stderr.startswith("apnc: ")


def test_walk_writes_what_it_promises(tmp_path: Path) -> None:
    done = apnc("walk", "--duration", "3", "--json", "copy.json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "apnc-walk"
    summary = json.loads((folder / "summary.json").read_text())
    assert json.loads((tmp_path / "copy.json").read_text()) == summary
    promised = {
        "method", "mi", "seed", "duration_s", "fell", "converged", "convergence_time_s",
        "convergence_time_authors_s", "phi_final", "speed_m_per_s", "duty_factor", "balance",
        "coordination", "cost_of_transport", "real_time_factor", "fmu_share_of_wall_time",
    }  # fmt: skip
    assert promised <= set(summary)
    assert set(summary["duty_factor"]) == {"RF", "RH", "LF", "LH"}
    with (folder / "record.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 180
    assert float(rows[60]["time"]) == pytest.approx(1.0)
    assert {"RF.o1", "phi12", "kappa", "position.x", "LH.foot_force.z"} <= set(rows[0])
    assert (folder / "report.html").stat().st_size > 100_000


def test_same_seed_same_record_other_seed_other_record(tmp_path: Path) -> None:
    for name, seed in (("a", "1"), ("b", "1"), ("c", "2")):
        apnc("walk", "--duration", "2", "--seed", seed, "--output", name, cwd=tmp_path)
    a, b, c = ((tmp_path / name / "record.csv").read_bytes() for name in "abc")
    assert a == b
    assert a != c


@pytest.mark.skipif(os.name == "nt", reason="sends SIGINT to a process")
def test_interrupted_walk_keeps_what_it_has(tmp_path: Path) -> None:
    command = [*APNC, "walk", "--duration", "3000"]
    process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    time.sleep(8)
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "interrupted; what was recorded is in apnc-walk" in stderr
    summary = json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())
    assert summary["complete"] is False
    assert 0.0 < summary["duration_s"] < 3000.0
    assert (tmp_path / "apnc-walk" / "report.html").is_file()


def test_info_shows_the_interface(tmp_path: Path) -> None:
    done = apnc("info", cwd=tmp_path)
    assert done.returncode == 0
    assert "leg[4].theta_knee" in done.stdout and "FMI 2.0" in done.stdout


def test_example_drives_the_fmu_with_fmpy_alone(tmp_path: Path) -> None:
    script = Path(__file__).resolve().parents[2] / "examples" / "drive_fmu.py"
    assert len(script.read_text().splitlines()) <= 40
    assert apnc("build", cwd=tmp_path).returncode == 0
    done = subprocess.run(
        [sys.executable, str(script), "Apnc.fmu"],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.splitlines()) == 10
