"""The pages on robots list every key of a robot file, and the values of the shipped files."""

import re
import tomllib
from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any

import pytest
from pydantic import TypeAdapter

from apnc_plant.robot import (
    ROBOTS,
    Body,
    Contact,
    JointInFile,
    Leg,
    RobotDescription,
    Sensor,
    Servo,
    Trunk,
)

PAGE = Path(__file__).resolve().parents[3] / "docs" / "robots" / "own.md"
PARTS = {
    "trunk": Trunk,
    "leg": Leg,
    "leg.hip": Body,
    "servo": Servo,
    "contact": Contact,
    "sensor": Sensor,
}


def units(part: Any) -> dict[str, str]:
    """Unit of every key of a part that is no table; empty where there is none."""
    found = {}
    for name, schema in TypeAdapter(part).json_schema()["properties"].items():
        schema = schema.get("anyOf", [schema])[0]  # the others: nothing
        value = schema.get("prefixItems", [schema])[0]
        if "$ref" not in value:
            found[name] = value.get("unit", "")
    return found


def listed() -> dict[str, tuple[str, str]]:
    rows = re.findall(r"^\| (`[^|]*) \| ([^|]*)\| ([^|]*)\|", PAGE.read_text(), re.MULTILINE)
    return {
        key: (unit.strip(), default.strip())
        for keys, unit, default in rows
        for key in re.findall(r"`([^`]*)`", keys)
    }


@pytest.mark.parametrize("path", PARTS)
def test_every_key_is_on_the_page(path: str) -> None:
    rows, part = listed(), PARTS[path]
    for entry in fields(part):
        if entry.name not in units(part):
            continue
        owner = "legs[k]" if part is Leg and entry.name in ("name", "mount") else path
        default = "" if entry.default is MISSING else str(entry.default)
        assert rows[f"{owner}.{entry.name}"] == (units(part)[entry.name], default)


def test_the_page_lists_no_key_that_is_gone() -> None:
    known = {f"{path}.{name}" for path, part in PARTS.items() for name in units(part)}
    known |= {f"leg.{link}.{name}" for link in ("femur", "tibia") for name in units(Body)}
    known |= {f"legs[k].joints.JOINT.{name}" for name in units(JointInFile)}
    known |= {"name", "rate", "mi_range", "mi", "legs[k].name", "legs[k].mount", "controller.NAME"}
    assert set(listed()) <= known


def test_the_keys_at_the_top_are_on_the_page() -> None:
    rows, found = listed(), units_of_top()
    assert found == {name: rows[name][0] for name in found} != {}


def units_of_top() -> dict[str, str]:
    """Unit of every number at the top of a robot file."""
    found = {}
    for name, schema in TypeAdapter(RobotDescription).json_schema()["properties"].items():
        value = schema.get("anyOf", [schema])[0]
        value = value.get("prefixItems", [value])[0]
        if "unit" in value:
            found[name] = value["unit"]
    return found


def value_at(table: Any, key: str) -> Any:
    """Value at a key such as ``legs[1].mount``; legs are counted from 1."""
    for name, index in re.findall(r"(\w+)(?:\[(\d+)\])?\.?", key):
        table = table[name][int(index) - 1] if index else table[name]
    return table


@pytest.mark.parametrize("robot", ["lilibot", "hexapod", "octopod"])
def test_values_on_the_page_are_those_of_the_file(robot: str) -> None:
    table = tomllib.loads((ROBOTS / f"{robot}.toml").read_text("utf-8"))
    page = (PAGE.parent / f"{robot}.md").read_text("utf-8")
    rows = re.findall(r"^\| (`[\w.\[\]]+`(?:, `[^|]+)?) \| ([^|]*)\|", page, re.MULTILINE)
    assert len(rows) > 8
    for keys, value in rows:
        for key in re.findall(r"`([^`]+)`", keys):
            found = value_at(table, key)
            if value.strip():
                assert found == tomllib.loads(f"value = {value}")["value"], key
