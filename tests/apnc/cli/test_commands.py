"""The command line as a person uses it."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("uses a terminal and limits of the system", allow_module_level=True)

import resource

from stiff import stiff_robot
from terminal import APNC, apnc

from apnc import Gait, read_gait, write_gait
from apnc.cli import main as command_line
from apnc.studies.registry import STUDIES
from apnc_plant.robot import ROBOTS, load_robot

HEAVY = {"exudyn", "apnc_plant.ground", "fmpy", "loky", "numpy", "plotly", "scipy"}


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Exit code and what was printed, of a command run here: faster than in its own process."""
    with pytest.raises(SystemExit) as end:
        command_line.main(list(words))
    assert isinstance(end.value.code, int)
    return end.value.code, *capsys.readouterr()


@pytest.mark.parametrize("words", [[], ["walk"], ["build"], ["study"], ["study", "mi"], ["gait"]])
def test_help_imports_nothing_heavy_and_keeps_its_brackets(words: list[str]) -> None:
    command = [sys.executable, "-X", "importtime", "-m", "apnc", *words, "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    imported = {line.split("|")[-1].strip() for line in done.stderr.splitlines()}
    assert "apnc.cli.walk" in imported
    assert imported & HEAVY == set()
    if words == ["walk"]:
        for unit in ("[s]", "[deg]", "[Hz]"):
            assert unit in done.stdout


def test_no_command_shows_the_help() -> None:
    done = subprocess.run(APNC, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "Usage: apnc" in done.stdout + done.stderr
    assert "apnc: " not in done.stderr


def test_studies_are_listed_with_title_and_place(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "study", "--help")
    assert code == 0
    for entry in STUDIES.values():
        (line,) = [x for x in out.splitlines() if x.split()[:1] == [entry.name]]
        assert entry.title in line and entry.section in line


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["walk", "--controller", "cow"], "controller 'cow' is not one of apnc, apc, tegotae, "),
        (["walk", "--duration", "-3"], "duration = -3.0 s is not a positive time"),
        (["walk", "--duration", "nan"], "duration is nan; allowed: a finite number"),
        (["walk", "--duration", "1e308"], "duration = 1e+308 s is not a positive time"),
        (["walk", "--duration", "0.001"], "duration = 0.001 s is not one tick"),
        (["walk", "--rate", "0"], "rate = 0.0 Hz is not in 1 ... 10000 Hz"),
        (["walk", "--mi", "7"], "mi: 7.0 is not in 0 ... 1"),
        (["walk", "--mi", "fast"], "mi = 'fast' is not a value"),
        (["walk", "--seed", "-1"], "seed is -1; allowed: a whole number from 0 to 2^64 - 1"),
        (["walk", "--seed", "1.5"], "'--seed'"),
        (["walk", "--preset", "cow"], "preset 'cow' is not one of robot, lilibot, paper"),
        (["walk", "--set", "cow=1"], "parameter 'cow' is not one of Ts, robot_weight, F_max"),
        (["walk", "--set", "xi=moo"], "xi = 'moo'; allowed: a number"),
        (["walk", "--set", "xi=7"], "xi = 7; allowed: a number from 0 to 1"),
        (["walk", "--set", "xi=true"], "xi = True; allowed: a number"),
        (["walk", "--set", "Ts=1"], "--set Ts is not taken; --rate says it"),
        (["build-system", "--set", "Ts=1"], "--set Ts is not taken; --rate says it"),
        (["walk", "--set", "method=apc"], "--set method is not taken; --controller says it"),
        (["walk", "--set", "N=3.7"], "N = 3.7; allowed: a whole number"),
        (["walk", "--set", "kappa_rule=never"], "kappa_rule = 'never' is not one of armed"),
        (["walk", "--robot", "cow"], "robot 'cow'"),
        (["walk", "--condition", "C9"], "conditions 'C9' are not one of"),
        (["walk", "--fmu", "no.fmu"], "no.fmu: no such file"),
        (["walk", "--fmu", "text.fmu"], "text.fmu: not an FMU"),
        (["walk", "--gait", "text.fmu"], "gait file text.fmu: not readable as JSON"),
        (["walk", "--output", "text.fmu/x"], "output folder text.fmu/x cannot be written"),
        (["walk", "--json", "."], "file . is a folder"),
        (["walk", "--json", "new/"], "'--json': new/ is a folder; allowed: a file"),
        (["walk", "--mcap", "new/"], "'--mcap': new/ is a folder"),
        (["build", "--output", "new/"], "'--output': new/ is a folder"),
        (["gait", "save", "run", "new/"], "new/ is a folder"),
        (["walk", "--json", "x", "--mcap", "x"], "--mcap x would overwrite a file of --json"),
        (["walk", "--json", "a/../x", "--mcap", "./x"], "would overwrite a file of --json"),
        (
            ["walk", "--json", "apnc-walk/report.html"],
            "--json apnc-walk/report.html would overwrite a file of --output",
        ),
        (["walk", "--output", "a", "--mcap", "a/record.csv"], "overwrite a file of --output"),
        (["walk", "--fmu", "text.fmu", "--json", "text.fmu"], "overwrite a file of --fmu"),
        (["walk", "--robot", "r.toml", "--mcap", "r.toml"], "overwrite a file of --robot"),
        (["walk", "--params", "p.json", "--json", "p.json"], "overwrite a file of --params"),
        (["walk", "--gait", "g.json", "--json", "g.json"], "overwrite a file of --gait"),
        (["build", "--params", "p.ssv", "--output", "p.ssv"], "overwrite a file of --params"),
        (["build", "--robot", "r.toml", "--output", "r.toml"], "overwrite a file of --robot"),
        (
            ["export-robot", "--robot", "r.toml", "--output", "./r.toml"],
            "--output r.toml would overwrite a file of --robot",
        ),
        (["gait", "save", "run", "run/record.csv"], "would overwrite a file of the run"),
        (["info", "."], ".: a folder, not an FMU"),
        (["walk", "--fmu", "."], ".: a folder, not an FMU"),
        (["walk", "--output", ""], "--output is empty"),
        (["study", "mi", "--output=", "--trials", "1"], "--output is empty"),
        (["gait", "show", ""], "show is empty"),
        (["info", "text.fmu"], "text.fmu: not an FMU"),
        (["gait", "save", "nowhere", "gait.json"], "record.csv cannot be read"),
        (["gait", "save", "nowhere", "x", "--format", "xml"], "format 'xml' is not one of"),
        (["build", "--legs", "1"], "legs = 1 is not in 2 ... 64"),
        (["build", "--platform", "vax"], "platform 'vax' is not one of"),
        (["build", "--set", "N=3.7"], "N = 3.7"),
        (["build", "--robot", "cow"], "robot 'cow' is unknown; allowed: hexapod, lilibot, octopod"),
        (["build", "--robot", "hexapod", "--legs", "4"], "legs = 4: robot 'hexapod' has 6"),
        (["study", "mi", "--robot", "cow"], "robot 'cow' is unknown; allowed: hexapod, lilibot"),
        (["study", "gains", "--robot", "hexapod"], "--robot"),
        (["moo"], "moo"),
        (["walk", "--moo"], "--moo"),
        (["study", "mi", "--trials", "0"], "trials = 0 is not at least 1"),
        (["study", "mi", "--controllers", "cow"], "cow"),
    ],
)  # fmt: skip
def test_bad_use_is_one_line_and_code_2(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("text.fmu").write_text("no zip")
    Path("r.toml").write_text((ROBOTS / "lilibot.toml").read_text())
    code, _, err = run(capsys, *arguments)
    assert code == 2
    assert words in err
    assert len(err.strip().splitlines()) == 1
    assert err.startswith("apnc: ")


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


def test_same_seed_same_record_other_seed_other_record(tmp_path: Path) -> None:
    for name, seed in (("a", "1"), ("b", "1"), ("c", "2")):
        apnc("walk", "--duration", "2", "--seed", seed, "--output", name, cwd=tmp_path)
    a, b, c = ((tmp_path / name / "record.csv").read_bytes() for name in "abc")
    assert a == b
    assert a != c


@pytest.mark.parametrize(
    ("env", "encoding"),
    [
        ({"PYTHONIOENCODING": "cp1252"}, "cp1252"),
        ({"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}, "ascii"),
    ],
)
def test_a_console_without_greek_letters_shows_the_rest(
    env: dict[str, str], encoding: str, tmp_path: Path
) -> None:
    done = apnc("walk", "--duration", "1", cwd=tmp_path, encoding=encoding, env=env)
    assert done.returncode == 0, done.stderr
    assert "?12 0." in done.stdout.replace("\xa0", " ")  # phi, and a space that does not break
    assert "report: apnc-walk/report.html" in done.stdout


def test_a_fall_is_said_and_has_its_own_code(tmp_path: Path) -> None:
    words = ("--duration", "9", "--slope", "60")
    done = apnc("walk", *words, cwd=tmp_path)
    assert done.returncode == 1, done.stderr
    summary = json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())
    assert summary["end"] == "fell" and summary["duration_s"] < 9.0
    said = f"fell at {summary['duration_s']:.2f} s; what was recorded is in apnc-walk"
    assert said in done.stderr
    assert "fell" in done.stdout


def test_a_run_that_diverges_is_not_interrupted_and_shows_no_huge_numbers(tmp_path: Path) -> None:
    (tmp_path / "stiff.toml").write_text(stiff_robot())
    done = apnc("walk", "--robot", "stiff.toml", "--duration", "9", cwd=tmp_path)
    assert done.returncode == 1, done.stderr
    assert "diverged at" in done.stderr and "interrupted" not in done.stderr + done.stdout
    assert "e+" not in done.stdout
    assert json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())["end"] == "diverged"


def test_a_full_disk_names_the_file_and_leaves_the_older_run(tmp_path: Path) -> None:
    assert apnc("walk", "--duration", "1", cwd=tmp_path).returncode == 0
    folder = tmp_path / "apnc-walk"
    before = {path.name: path.read_bytes() for path in folder.iterdir()}

    def little_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (600_000, 600_000))

    done = subprocess.run(
        [*APNC, "walk", "--duration", "25"],
        cwd=tmp_path, capture_output=True, text=True, check=False, preexec_fn=little_room,
    )  # fmt: skip
    assert done.returncode == 2
    assert "apnc-walk/record.csv" in done.stderr.splitlines()[-1]
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize("fmi", ["2", "3"])
def test_info_shows_the_interface_of_what_build_made(
    fmi: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    assert run(capsys, "build", "--platform", "host", "--fmi", fmi)[0] == 0
    code, out, err = run(capsys, "info", "Apnc.fmu")
    assert code == 0, err
    assert f"FMI {fmi}.0 co-simulation" in out
    assert ("leg[4].theta_knee" if fmi == "2" else "theta_knee[4]") in out


def test_a_walk_refuses_fmi_3_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    run(capsys, "build", "--platform", "host", "--fmi", "3")
    code, _, err = run(capsys, "walk", "--fmu", "Apnc.fmu", "--duration", "1")
    assert code == 2 and "Apnc.fmu: FMI 3.0; a walk takes FMI 2.0" in err


def test_a_built_fmu_starts_with_what_was_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import fmpy  # noqa: PLC0415

    monkeypatch.chdir(tmp_path)
    write_gait(Gait(("RF", "RH", "LF", "LH"), (3.1, 3.2, 0.1)), Path("gait.json"))
    Path("own.toml").write_text("xi = 0.07\nrobot_weight = 30.0")
    code, _, err = run(
        capsys, "build", "--platform", "host", "--gait", "gait.json", "--params", "own.toml",
        "--set", "robot_weight=33", "--controller", "tegotae", "--enumerations", "integer",
    )  # fmt: skip
    assert code == 0, err
    start = {v.name: v.start for v in fmpy.read_model_description("Apnc.fmu").modelVariables}
    found = [float(start[name]) for name in ("xi", "robot_weight", "method", "phi_stored[2]")]
    assert found == [0.07, 33.0, 3.0, 3.2]
    assert start["stored"] == "true"


@pytest.mark.parametrize(
    ("words", "legs"),
    [
        ((), "RF, RH, LF, LH"),
        (("--legs", "6"), "RF, RM, RH, LF, LM, LH"),
        (("--robot", "own.toml"), "FR, RH, LF, LH"),
        (("--legs", "5"), "R1, R2, L1, L2, L3"),
    ],
)
def test_a_built_fmu_takes_no_gait_of_other_legs(
    words: tuple[str, ...],
    legs: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("own.toml").write_text((ROBOTS / "lilibot.toml").read_text().replace('"RF"', '"FR"'))
    write_gait(Gait(("LF", "RF", "LH", "RH"), (3.1, 3.2, 0.1)), Path("gait.json"))
    code, _, err = run(capsys, "build", *words, "--gait", "gait.json")
    assert code == 2
    assert f"the gait is of legs LF, RF, LH, RH; the robot has {legs}" in err
    assert not Path("Apnc.fmu").exists()


@pytest.mark.parametrize("words", [("--legs", "6"), ("--robot", "hexapod")])
def test_the_fmu_of_a_robot_starts_with_the_preset_of_its_file(
    words: tuple[str, ...],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import fmpy  # noqa: PLC0415

    monkeypatch.chdir(tmp_path)
    robot = load_robot("hexapod")
    code, _, err = run(capsys, "build", "--platform", "host", *words)
    assert code == 0, err
    start = {v.name: v.start for v in fmpy.read_model_description("Apnc.fmu").modelVariables}
    assert robot.controller and "leg[6].grf" in start and "leg[7].grf" not in start
    assert {name: float(start[name]) for name in robot.controller} == dict(robot.controller)
    assert float(start["robot_weight"]) == pytest.approx(robot.weight)


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


def test_a_gait_is_kept_shown_and_walked_with(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ("--set", "stored=true", "--set", "phi_stored=[3.1,3.2,0.1]", "--duration", "1")
    assert run(capsys, "walk", *words, "--output", "first")[0] == 0
    assert run(capsys, "gait", "save", "first", "gait.json")[0] == 0
    assert read_gait("gait.json").phi == (3.1, 3.2, 0.1)
    assert "LH 0.10 rad" in run(capsys, "gait", "show", "gait.json")[1]
    assert run(capsys, "gait", "save", "first", "gait.ssv", "--format", "ssv")[0] == 0
    for option, file in (("--gait", "gait.json"), ("--params", "gait.ssv")):
        assert run(capsys, "walk", option, file, "--duration", "1")[0] == 0
        again = json.loads(Path("apnc-walk/summary.json").read_text())
        assert again["parameters"]["phi_stored"] == [3.1, 3.2, 0.1]
        assert again["parameters"]["stored"] is True


def test_a_release_is_wired(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def release(folder: Path, progress: object) -> list[Path]:
        return [folder / "one.fmu", folder / "SHA256SUMS"]

    monkeypatch.setattr("build_fmu.release.release", release)
    code, out, _ = run(capsys, "build", "--release", str(tmp_path / "files"))
    assert (code, out) == (0, f"{tmp_path / 'files'}: one.fmu, SHA256SUMS\n")
    assert (tmp_path / "files").is_dir()


def test_a_study_is_written_and_resumed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ("study", "mi", "--mi", "0.1, 0.2", "--controllers", "apnc", "--duration", "1")
    more = ("--trials", "1", "--workers", "1", "--series")
    code, out, err = run(capsys, *words, *more)
    assert code == 0, err
    assert out == "2 trials, 2 complete; report: apnc-study-mi/report.html\n"
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
    rows = [{"end": end} for end in ends]
    monkeypatch.setattr("apnc.studies.runner.run_study", lambda *_, **__: rows)
    code, out, _ = run(capsys, "study", "rate", "--output", str(tmp_path))
    assert code == 1
    assert out.startswith(
        "5 trials, 1 complete, 1 diverged, 1 ended with an error, 2 fell; report: "
    )
