"""The study of the robot's numbers: every change changes what it names, and the table says so."""

from __future__ import annotations

import csv
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest
from apnc.studies.sensitivity_study import CHANGES, run_sensitivity, sensitivity_markdown

from exudyn_models.robot.file import load_robot

ROBOT = load_robot("lilibot")


def leaves(value: Any, name: str = "") -> dict[str, Any]:
    """Every number of nested data, by its place."""
    if isinstance(value, dict):
        pairs = list(value.items())
    elif isinstance(value, (list, tuple)):
        pairs = list(enumerate(value))
    else:
        return {name: value}
    return {k: v for key, part in pairs for k, v in leaves(part, f"{name}/{key}").items()}


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_touches_one_number_of_each_part(name: str) -> None:
    before, after = leaves(asdict(ROBOT)), leaves(asdict(CHANGES[name](ROBOT)))
    changed = [key for key in before if before[key] != after[key]]
    if name == "nothing":
        assert changed == []
    elif "tibia" in name:
        assert len(changed) == 2 * len(ROBOT.legs)
        assert CHANGES[name](ROBOT).mass == pytest.approx(ROBOT.mass)
    else:
        assert len(changed) == 1


def test_study_small(tmp_path: Path) -> None:
    table = run_sensitivity(tmp_path, 1, ("nothing", "friction 0.5"), duration=5.0)
    with table.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(r["change"], r["mi"]) for r in rows] == [
        ("nothing", "0.08"),
        ("nothing", "0.16"),
        ("friction 0.5", "0.08"),
        ("friction 0.5", "0.16"),
    ]
    assert all(r["error"] == "" for r in rows)
    assert rows[0]["path_speed_m_per_s"] != rows[2]["path_speed_m_per_s"]
    assert "| friction 0.5 |" in (tmp_path / "sensitivity.md").read_text()


def test_study_refuses(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="trials = 0"):
        run_sensitivity(tmp_path, 0)
    with pytest.raises(ValueError, match="change 'moon' is not one of nothing"):
        run_sensitivity(tmp_path, 1, ("moon",))


def test_table_shows_what_did_not_form() -> None:
    row = {"change": "nothing", "mi": 0.08, "path_speed_m_per_s": 0.05, "fell": 0}
    rows = [row | {"convergence_time_s": 3.21}, row | {"convergence_time_s": None, "fell": 1}]
    assert "| nothing | 3.2, - | 0.050 | 1/2 |" in sensitivity_markdown(rows)
