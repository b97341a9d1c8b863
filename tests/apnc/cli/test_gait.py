"""``apnc gait``: stored gaits as files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_line import run

from apnc import read_gait


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
        assert run(capsys, "walk", option, file, "--duration", "1", "--output", "again")[0] == 0
        again = json.loads(Path("again/summary.json").read_text())
        assert again["parameters"]["phi_stored"] == [3.1, 3.2, 0.1]
        assert again["parameters"]["stored"] is True
