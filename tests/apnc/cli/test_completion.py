"""Real shells complete commands, options and their values."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("types into shells of a terminal", allow_module_level=True)

from terminal import typed

from apnc.cli.completion import axis_of, controllers, robots, settings
from apnc.studies.registry import STUDIES

SHELLS = {"bash": ("bash", "-i"), "zsh": ("zsh", "-i"), "fish": ("fish",)}

CASES = {
    "build-s": "build-system",
    "walk --rough": "--roughness",
    "walk --robot l": "lilibot",
    "walk --robot wal": r"walker\.toml",
    "study mi --controllers apnc,tegotae_": "apnc,tegotae_best",
    "build --platform aarch64-d": "aarch64-darwin",
}
"""Words after ``apnc`` before the tab key, and what they are completed to."""


@pytest.mark.parametrize(
    "shell",
    [
        "bash",
        pytest.param("zsh", marks=pytest.mark.thorough),
        pytest.param("fish", marks=pytest.mark.thorough),
    ],
)
def test_a_shell_completes_names_and_values(
    shell: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not shutil.which(shell):
        pytest.skip(f"{shell} is not installed")
    apnc = tmp_path / "apnc"
    apnc.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m apnc "$@"\n')
    apnc.chmod(0o755)
    (tmp_path / "walker.toml").touch()
    for name in ("HOME", "ZDOTDIR", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path))
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    install = [shell, "-c", "apnc --install-completion; true"]  # it asks which shell calls it
    done = subprocess.run(install, capture_output=True, text=True, check=True)
    assert f"{shell} completion installed" in done.stdout
    if shell == "fish":  # it knows the folder of its settings by the home folder alone
        monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / ".config"))
    # the first tab in zsh only loads the script
    lines = {"apnc wal\t": ""} | {f"apnc {words}\t": found for words, found in CASES.items()}
    shown = typed(*SHELLS[shell], lines=lines, cwd=tmp_path)
    for (line, found), seen in zip(lines.items(), shown, strict=True):
        assert re.search(found, seen), (line, seen)


def test_values_are_those_that_the_commands_take() -> None:
    assert robots("") == ["hexapod", "lilibot", "octopod"]
    assert robots("x") == []
    assert controllers("tego") == ["tegotae", "tegotae_best"]
    assert settings("kappa_") == ["kappa_rule=", "kappa_hold="]
    assert settings("Ts") == settings("method") == []  # other options say these
    assert axis_of(STUDIES["conditions"], "condition")("C1,C") == ["C1,C2", "C1,C3", "C1,C4"]
    assert axis_of(None, "controllers")("apnc,apc") == ["apnc,apc"]
    assert not any(" " in value for value in axis_of(STUDIES["steering"], "schedule")(""))
