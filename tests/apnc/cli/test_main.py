"""The command line as a whole: help, bad input and consoles."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("uses a terminal and limits of the system", allow_module_level=True)


from command_line import run
from terminal import APNC, apnc

from apnc_plant.robot import ROBOTS

HEAVY = {"exudyn", "apnc_plant.ground", "fmpy", "loky", "numpy", "plotly", "scipy"}


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
        (["walk", "--condition", "C9"], "conditions: 'C9' is not one of C1, C2"),
        (["walk", "--fmu", "no.fmu"], "no.fmu: no such file"),
        (["walk", "--fmu", "text.fmu"], "text.fmu: not an FMU"),
        (["walk", "--gait", "text.fmu"], "gait file text.fmu: not readable as JSON"),
        (["walk", "--output", "text.fmu/x"], "output folder text.fmu/x cannot be written"),
        (["walk", "--json", "."], "file . is a folder"),
        (["walk", "--json", "new/"], "'--json': new/ is a folder; allowed: a file"),
        (["walk", "--mcap", "new/"], "'--mcap': new/ is a folder"),
        (["build", "--output", "new/"], "'--output': new/ is a folder"),
        (["build-plant", "--output", "new/"], "'--output': new/ is a folder"),
        (["build-system", "--output", "new/"], "'--output': new/ is a folder"),
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
        (["build-plant", "--robot", "r.toml", "--output", "r.toml"], "overwrite a file of --robot"),
        (["build-system", "--gait", "g.ssp", "--output", "g.ssp"], "overwrite a file of --gait"),
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
