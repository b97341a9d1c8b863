"""Pages on how far the gait carries: what is kept, and that pages show it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from made_up_results import made_up

from apnc.studies.report import write_table
from apnc.studies.results import STRICT
from research.docs import DOCS, manifest, reach


def test_a_table_is_read_as_it_was(tmp_path: Path) -> None:
    row = {"a": None, "b": True, "c": 3, "d": 0.25, "e": "slope up 2 deg", "f": False}
    reach.write(tmp_path / "t.csv", [row])
    assert reach.read(tmp_path / "t.csv") == [row]


@pytest.fixture
def folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """The folder of a study, and a folder for the counts."""
    data = tmp_path / "docs"
    (data / "data").mkdir(parents=True)
    monkeypatch.setattr(reach, "DOCS", data)
    monkeypatch.setattr(manifest, "DOCS", data)
    monkeypatch.setattr(manifest, "FILE", data / "data" / "manifest.json")
    monkeypatch.setattr(manifest, "motion", lambda robot: f"moves as {robot}")
    manifest.FILE.write_text("{}")
    return tmp_path, data


def test_counts_are_kept_with_size_and_robot(folders: tuple[Path, Path]) -> None:
    folder, data = folders

    def figures(cell: dict[str, Any]) -> dict[str, Any]:
        return {STRICT: 2.0 if cell["seed"] else None, "robot": "hexapod"}

    axes = {"share": (0.0, 0.1), "walk": ("MI 0.08",)}
    write_table(made_up(axes, figures, ("apnc",), 4, "robustness"), folder / reach.TABLE_FILE)
    (folder / "claims.md").write_text("- trials: 8\n- commit: 0123abc\n")
    reach.keep(folder)
    first = reach.read(data / "data" / "reach_robustness.csv")[0]
    assert first == {
        "share": 0, "controller": "apnc", "walk": "MI 0.08", "bodies": 4, "strict": 3,
    }  # fmt: skip
    found = manifest.entries()
    assert set(found) == {
        "data/reach_robustness.csv", "table robustness", "table robustness-size",
    }  # fmt: skip
    size = {"walks": 8, "seconds": "45", "seeds": 4}
    moved = {"robots": {"hexapod": "moves as hexapod"}, "commit": "0123abc"}
    assert all(entry == moved | size for entry in found.values())


@pytest.mark.parametrize("name", reach.STUDIES)
def test_pages_show_the_counts_that_are_kept(name: str) -> None:
    study, rows = reach.STUDIES[name], reach.read(reach.data_of(name))
    page = (DOCS / study.page).read_text("utf-8")
    for mark, table in study.tables.items():
        assert f"<!-- {mark} -->\n{table(rows)}" in page
    assert reach.sizes_table(study.page) in page
