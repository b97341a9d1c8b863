"""The FMU of a robot of the gallery walks as the compiled engine does."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import pytest

from apnc_plant.robot import ROBOTS
from build_fmu.build import host_fmu
from research.gallery import fmus


def test_the_walk_in_the_fmu_is_that_of_the_compiled_engine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def built(words: list[str], check: bool) -> subprocess.CompletedProcess[str]:
        assert words[2:6] == ["apnc", "build", "--robot", str(lilibot)]
        Path(words[-1]).write_bytes(host_fmu().read_bytes())
        return subprocess.CompletedProcess(words, 0)

    lilibot = ROBOTS / "lilibot.toml"
    monkeypatch.setattr(subprocess, "run", built)
    monkeypatch.setattr(fmus, "duration_of", lambda robot: 3.0)
    found: dict[str, Any] = fmus.fmu_of(lilibot, tmp_path / "lilibot.fmu")
    assert found["kB"] > 50
    assert found["rate"] == pytest.approx(60.0)
    assert found["weight"] == pytest.approx(24.525, rel=1e-3)
    assert found["apart"] < 1e-9
