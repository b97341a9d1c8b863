"""What README shows is true: its film, its badges and what a walk prints."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from command_line import run
from PIL import Image

from build_fmu.model import FMI_VERSIONS

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text("utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def test_its_first_content_is_a_small_film() -> None:
    _, first, _ = README.split("\n\n", 2)
    (name,) = re.findall(r'<img src="([^"]+)"', first)
    film = ROOT / name
    assert film.stat().st_size <= 500_000  # bytes
    with Image.open(film) as picture:
        assert picture.is_animated


def test_badges_are_true() -> None:
    badges = dict(re.findall(r"^!\[(\w+): (.*)\]\(docs/pictures/badge", README, re.M))
    assert badges == {
        "Licence": PROJECT["license"],
        "Python": PROJECT["requires-python"].removeprefix(">=") + " or newer",
        "FMI": " and ".join(f"{version}.0" for version in FMI_VERSIONS),
    }
    for name, value in badges.items():
        drawn = (ROOT / "docs" / "pictures" / f"badge-{name.lower()}.svg").read_text("utf-8")
        assert f">{value}</text>" in drawn


def test_a_walk_prints_what_it_says(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Regression values: those of the default walk in Exudyn."""
    (shown,) = re.findall(r"```text\n(.*?)```", README, re.S)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    code, out, _ = run(capsys, "walk")
    assert code == 0
    printed = [" ".join(line.split()) for line in out.splitlines()]
    for line in shown.splitlines():
        words = " ".join(line.split())
        assert any(each.startswith(words) for each in printed), line
