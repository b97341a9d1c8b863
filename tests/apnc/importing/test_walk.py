"""An imported robot walks, and the command says what was found."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from dog_urdf import FEMUR, FOOT_AHEAD, SHANK, Dog

import apnc
from apnc.cli import main as command_line
from apnc.importing import import_robot
from apnc_plant.robot import load_robot


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as end:
        command_line.main(list(words))
    assert isinstance(end.value.code, int)
    return end.value.code, *capsys.readouterr()


def test_an_imported_dog_walks(tmp_path: Path) -> None:
    model, path = tmp_path / "dog.urdf", tmp_path / "robot.toml"
    model.write_text(Dog().text())
    found = import_robot(model)
    path.write_text(found.toml)
    record = apnc.simulate(
        apnc.Experiment(robot=str(path), engine="compiled", duration=20.0, mi=0.15)
    )
    leg = FEMUR + math.hypot(SHANK, FOOT_AHEAD)
    assert found.robot.rate == pytest.approx(60.0 * math.sqrt(0.155 / leg))
    assert record.experiment.rate == found.robot.rate
    features = apnc.walk_features(record)
    assert record.complete
    assert features.gait == "trot"
    assert features.distance_m > 0.5


def test_the_command_writes_the_file_and_says_what_was_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, path = tmp_path / "dog.urdf", tmp_path / "sub" / "dog.toml"
    model.write_text(Dog(effort=1000.0).text())
    code, out, err = run(capsys, "import-robot", str(model), "--output", str(path))
    assert (code, err) == (0, "")
    robot = load_robot(path)
    assert robot.mass == pytest.approx(8.0 + 1.3 + 4 * 1.95)
    shown = " ".join(out.split())
    for words in (
        "dog.urdf: dog, 17.1 kg, 4 legs of 0.41 m",
        "fr_haa = -q",
        "servo.stiffness",
        "effort 1000 N m of 12 joints",
        "arm_yaw is held",
        f"apnc walk --robot {path} --engine compiled",
        "update rate: 36.9 Hz, at which it moves as Lilibot does at 60 Hz",
    ):
        assert words in shown, words


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (["no.urdf"], "no.urdf: it cannot be read"),
        (["dog.urdf", "--pose", "sit"], "pose is 'sit'; allowed: zero"),
        (["dog.urdf", "--output", "dog.urdf"], "would overwrite a file of the model"),
        (["dog.urdf", "--output", "dog.json"], "allowed: a name that ends in .toml"),
    ],
)
def test_a_mistake_is_one_line(
    words: list[str],
    error: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("dog.urdf").write_text(Dog().text())
    code, out, err = run(capsys, "import-robot", *words)
    assert (code, out) == (2, "")
    assert error in err
    assert len(err.splitlines()) == 1
    assert Path("dog.urdf").read_text() == Dog().text()
