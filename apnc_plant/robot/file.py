"""Robot descriptions read from TOML files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, Final

from apnc_plant.files import Location, checked_table, read_table
from apnc_plant.robot.model import RobotDescription
from apnc_plant.robot.quantities import RobotDescriptionError

Table = Mapping[str, Any]

ROBOTS: Final = Path(__file__).parent / "robots"
"""Folder of the shipped robots."""

_KEYS: Final = {"leg"} | {field.name for field in fields(RobotDescription)}


def load_robot(name_or_path: str | Path) -> RobotDescription:
    """Read a robot description.

    Args:
        name_or_path: name of a shipped robot (``"lilibot"``) or path of a TOML file. Its keys are
            the fields of the classes in ``robot.model``; angles are in degrees. ``[leg]`` holds
            what the legs have in common, a table in ``[[legs]]`` what one leg has of its own.

    Raises:
        RobotDescriptionError: the file is missing, is no TOML, or holds a value out of range.
    """
    path = _find(str(name_or_path))
    try:
        table = read_table(path)
        for key in table.keys() - _KEYS:
            raise ValueError(f"{key} is {table[key]!r}; allowed: only {', '.join(sorted(_KEYS))}")
        common, legs = table.pop("leg", {}), table.get("legs")
        if not isinstance(common, dict):
            raise ValueError(f"leg is {common!r}; allowed: a table")
        if isinstance(legs, list):
            table["legs"] = [_leg(common, own) for own in legs]
        return checked_table(RobotDescription, table, shown_as=lambda at: _written_at(at, legs))
    except ValueError as error:
        raise RobotDescriptionError(f"robot file {path.name}: {error}") from error


def _find(name_or_path: str) -> Path:
    shipped = sorted(path.stem for path in ROBOTS.glob("*.toml"))
    if name_or_path in shipped:
        return ROBOTS / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if path.suffix == ".toml" and path.is_file():
        return path
    raise RobotDescriptionError(
        f"robot {name_or_path!r} is unknown; allowed: {', '.join(shipped)} or the path of a .toml"
    )


def _leg(common: Table, own: Any) -> Any:
    """A leg: what all legs have in common, replaced by what its own table holds."""
    if not isinstance(own, dict):
        return own
    own = dict(own)
    if isinstance(own.get("hip"), list):  # older files call the mount hip
        own["mount"] = own.pop("hip")
    leg = {**common, **own}
    for key, value in own.items():
        if isinstance(value, dict) and isinstance(common.get(key), dict):
            leg[key] = {**common[key], **value}
    return leg


def _written_at(location: Location, legs: Any) -> Location:
    """Where a value of a robot is written in its file: some of a leg is in the table of all."""
    match location:
        case ("legs", int(index), key, *rest) if key not in ("name", "mount", *legs[index]):
            return ("leg", key, *rest)
    return location
