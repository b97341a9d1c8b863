"""Engines by name, the closed loop in MuJoCo, and the replay of the same commands in both."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path

import pytest
import typer

from apnc import Experiment, simulate, walk_features
from apnc.cli.app import app
from apnc.cli.main import main
from apnc.cli.walk import experiment_of
from apnc.extras import missing
from apnc.loop.provenance import what_was_run

needs_mujoco = pytest.mark.skipif(
    "not __import__('importlib').util.find_spec('mujoco')", reason="mujoco is not installed"
)


def test_the_command_line_says_the_engine() -> None:
    experiment = Experiment(engine="mujoco")
    words = shlex.split(experiment.command())[2:]
    command = typer.main.get_command(app).commands["walk"]  # type: ignore[attr-defined]
    assert experiment_of(command.make_context("walk", words).params) == experiment


def test_an_unknown_engine_is_refused() -> None:
    with pytest.raises(ValueError, match="engine 'cow' is not one of exudyn, mujoco"):
        Experiment(engine="cow")


def test_a_missing_package_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    for name in [name for name in sys.modules if name.split(".")[0].startswith("mujoco")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "mujoco", None)
    for words in (
        ["walk", "--engine", "mujoco", "--duration", "1", "--output", str(tmp_path / "walk")],
        ["export-robot", "--format", "mjcf", "--output", str(tmp_path / "robot.xml")],
    ):
        with pytest.raises(SystemExit) as end:
            main(words)
        assert end.value.code == 2
        assert missing("mujoco", "mujoco") in capsys.readouterr().err


@needs_mujoco
@pytest.mark.parametrize(("form", "word"), [("mjcf", "<mujoco"), ("urdf", "<robot")])
def test_a_robot_is_exported(
    form: str, word: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "new" / "robot"
    with pytest.raises(SystemExit) as end:
        main(["export-robot", "--format", form, "--robot", "hexapod", "--output", str(path)])
    assert end.value.code == 0
    assert word in path.read_text()
    assert f"{path}: hexapod, 6 legs" in capsys.readouterr().out


@pytest.mark.parametrize("made", [False, True])
@pytest.mark.parametrize("root", ["trunk", "base"])
def test_a_robot_is_exported_into_a_folder(
    root: str, made: bool, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    folder = tmp_path / "new"
    if made:
        folder.mkdir()
    output = str(folder) if made else f"{folder}/"
    with pytest.raises(SystemExit) as end:
        main(["export-robot", "--format", "urdf", "--root", root, "--output", output])
    assert end.value.code == 0
    assert "floating_base" in (folder / "lilibot.urdf").read_text() or root == "trunk"
    assert f"{folder / 'lilibot.urdf'}: lilibot, 4 legs" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--format", "sdf"], "format 'sdf' is not one of mjcf, urdf"),
        (["--format", "urdf", "--servo", "dcmotor"], "servo = dcmotor; allowed with format mjcf only"),
        (["--format", "urdf", "--root", "cow"], "root 'cow' is not one of trunk, base"),
        (["--root", "base"], "root = base; allowed with format urdf only"),
        (["--robot", "cow"], "robot 'cow' is unknown"),
    ],
)
def test_what_cannot_be_exported_is_said(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as end:
        main(["export-robot", *words])
    assert end.value.code == 2
    assert message in capsys.readouterr().err


@needs_mujoco
def test_the_trot_forms_in_mujoco_as_in_exudyn() -> None:
    run = Experiment(mi=0.15, seed=1, duration=12.0)
    theirs = walk_features(simulate(run))
    record = simulate(Experiment(engine="mujoco", mi=0.15, seed=1, duration=12.0))
    ours = walk_features(record)
    assert ours.converged and theirs.converged
    assert ours.gait == theirs.gait == "trot"
    assert ours.stride_frequency_hz == pytest.approx(theirs.stride_frequency_hz, rel=0.1)
    assert "mujoco" in what_was_run(record.experiment)["versions"]
