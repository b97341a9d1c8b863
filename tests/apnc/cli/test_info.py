"""``apnc info``: what an FMU is."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run


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
