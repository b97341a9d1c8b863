"""Stored results of the documentation are those of today's robots, and each says so."""

from __future__ import annotations

import csv
import gzip
import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from apnc_plant.robot import load_robot
from research.docs import DOCS, manifest

OTHERS = {"tools", "couplings", "verdicts"}
"""Tables that their scripts write from a file of data, which has the entry."""


def data_files() -> set[str]:
    patterns = ("data/*.csv*", "formation/*.csv", "pictures/*.csv", "pictures/f*-mi-*")
    return {path.relative_to(DOCS).as_posix() for each in patterns for path in DOCS.glob(each)}


def tables() -> set[str]:
    """Marks above tables that come from a study."""
    text = "".join(page.read_text("utf-8") for page in DOCS.rglob("*.md"))
    marks = set(re.findall(r"<!-- ([\w-]+) -->\n\|", text))
    return {f"table {mark}" for mark in marks - OTHERS if not mark.startswith("legs-")}


def test_every_stored_result_has_an_entry_and_every_entry_a_result() -> None:
    names = set(manifest.entries())
    assert data_files() | tables() <= names
    others = names - data_files() - tables()
    assert [name for name in others if not (DOCS / name).is_file()] == []


def test_stored_results_are_those_of_todays_robots() -> None:
    assert manifest.stale() == {}, "measure them again, or mark them as of former robots"


def test_an_entry_names_what_was_measured_on_which_robots() -> None:
    for name, entry in manifest.entries().items():
        assert re.fullmatch("[0-9a-f]{7,12}(-dirty)?", entry["commit"]), name
        assert bool(entry.get("robots")) != bool(entry.get("former")), name


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A documentation of its own, without results."""
    (tmp_path / "manifest.json").write_text("{}")
    monkeypatch.setattr(manifest, "FILE", tmp_path / "manifest.json")
    monkeypatch.setattr(manifest, "DOCS", tmp_path)
    return tmp_path


def test_results_of_a_robot_that_has_changed_are_named(
    own: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    manifest.note(["lilibot"], own / "data" / "walks.csv", "gait")
    manifest.note(["hexapod", "octopod"], own / "legs.csv")
    assert manifest.stale() == {}
    lilibot = load_robot("lilibot")
    slippery = replace(lilibot, contact=replace(lilibot.contact, friction=0.79))
    assert slippery != lilibot
    walks = manifest.walks
    changed = {"lilibot": slippery}
    monkeypatch.setattr(
        manifest,
        "walks",
        lambda name: [replace(run, robot=changed.get(name, name)) for run in walks(name)],
    )
    manifest.motion.cache_clear()
    assert manifest.stale() == {"data/walks.csv": ["lilibot"], "table gait": ["lilibot"]}
    with pytest.raises(SystemExit, match=r"data/walks\.csv: lilibot changed"):
        manifest.main([])
    manifest.motion.cache_clear()


def test_results_are_copied_with_their_robots(own: Path) -> None:
    trials = own / "trials.csv"
    trials.write_text("study,robot,mi\nmi,hexapod,0.1\nmi,hexapod,0.2\n")
    manifest.main(["keep", str(trials), str(own / "walks.csv.gz")])
    with gzip.open(own / "walks.csv.gz", "rt", newline="") as file:
        assert [line["mi"] for line in csv.DictReader(file)] == ["0.1", "0.2"]
    (entry,) = json.loads(manifest.FILE.read_text()).items()
    assert entry[0] == "walks.csv.gz" and list(entry[1]["robots"]) == ["hexapod"]


def test_a_study_that_names_no_robot_walked_with_lilibot(tmp_path: Path) -> None:
    (tmp_path / "trials.csv").write_text("study,mi\nmi,0.1\n")
    assert manifest.robots_in(tmp_path / "trials.csv") == {"lilibot"}
    assert manifest.robots_in(tmp_path / "none.csv") == {"lilibot"}
