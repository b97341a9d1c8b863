"""``apnc info``: what an FMU is."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run
from dog_urdf import Dog


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


def test_info_of_a_robot_shows_what_its_file_says(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("dog.urdf").write_text(Dog().text())
    assert run(capsys, "import-robot", "dog.urdf", "--output", "dog.toml")[0] == 0
    code, out, err = run(capsys, "info", "--robot", "dog.toml")
    shown = " ".join(out.split())
    assert (code, err) == (0, "")
    for words in (
        "mass 17.1 kg",
        "update rate 36.88 Hz from its file",
        "MI 0.08 the default",
        "MI range not in its file",
        "RF right front 0.23 -0.07 0.03",
        "RF abduction fr_haa -1",
    ):
        assert words in shown, words
    code, out, err = run(capsys, "info", "own.fmu", "--robot", "dog.toml")
    assert (code, out) == (2, "")
    assert err == "apnc: own.fmu and --robot dog.toml: allowed is one of them\n"
