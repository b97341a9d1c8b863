"""``apnc export-robot``: a robot as MJCF or URDF."""

from __future__ import annotations

from pathlib import Path

import pytest

from apnc.cli.main import main

needs_mujoco = pytest.mark.skipif(
    "not __import__('importlib').util.find_spec('mujoco')", reason="mujoco is not installed"
)


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
        (
            ["--format", "urdf", "--servo", "dcmotor"],
            "servo = dcmotor; allowed with format mjcf only",
        ),
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
