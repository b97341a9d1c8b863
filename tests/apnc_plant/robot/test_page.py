"""The page on robot files lists every key, its unit and its default."""

import re
from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any

import pytest
from pydantic import TypeAdapter

from apnc_plant.robot import Body, Contact, Leg, Sensor, Servo, Trunk

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
    known |= {"name", "legs[k].name", "legs[k].mount", "controller.NAME"}
    assert {key for key in listed() if "." in key or key == "name"} <= known
