"""The pages of the shipped robots give the values of the robot files."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from apnc_plant.robot import ROBOTS

PAGES = Path(__file__).resolve().parents[3] / "docs" / "robots"


def value_at(table: Any, key: str) -> Any:
    """Value at a key such as ``legs[1].mount``; legs are counted from 1."""
    for name, index in re.findall(r"(\w+)(?:\[(\d+)\])?\.?", key):
        table = table[name][int(index) - 1] if index else table[name]
    return table


@pytest.mark.parametrize("robot", ["lilibot", "hexapod", "octopod"])
def test_values_on_the_page_are_those_of_the_file(robot: str) -> None:
    table = tomllib.loads((ROBOTS / f"{robot}.toml").read_text("utf-8"))
    page = (PAGES / f"{robot}.md").read_text("utf-8")
    rows = re.findall(r"^\| (`[\w.\[\]]+`(?:, `[^|]+)?) \| ([^|]*)\|", page, re.MULTILINE)
    assert len(rows) > 8
    for keys, value in rows:
        for key in re.findall(r"`([^`]+)`", keys):
            found = value_at(table, key)
            if value.strip():
                assert found == tomllib.loads(f"value = {value}")["value"], key
