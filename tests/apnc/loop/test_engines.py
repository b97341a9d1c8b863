"""Engines by name, and the closed loop in MuJoCo."""

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
def test_the_trot_forms_in_mujoco_as_in_exudyn() -> None:
    run = Experiment(mi=0.15, seed=1, duration=12.0)
    theirs = walk_features(simulate(run))
    record = simulate(Experiment(engine="mujoco", mi=0.15, seed=1, duration=12.0))
    ours = walk_features(record)
    assert ours.converged and theirs.converged
    assert ours.gait == theirs.gait == "trot"
    assert ours.stride_frequency_hz == pytest.approx(theirs.stride_frequency_hz, rel=0.1)
    assert "mujoco" in what_was_run(record.experiment)["versions"]
