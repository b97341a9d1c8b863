"""Robot descriptions read from TOML files."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Collection, Mapping
from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any, Final, TypeVar, get_type_hints

from apnc_plant.robot.model import Contact, Leg, RobotDescription, Sensor, Servo, Trunk
from apnc_plant.robot.quantity import (
    FLAT,
    Checked,
    NotAllowedError,
    RobotDescriptionError,
    rules,
)

Table = Mapping[str, Any]
Part = TypeVar("Part", bound=Checked)

ROBOTS: Final = Path(__file__).parent / "robots"
"""Folder of the robots that are shipped."""

_PARTS: Final[Mapping[str, type[Checked]]] = {
    "trunk": Trunk,
    "servo": Servo,
    "contact": Contact,
    "sensor": Sensor,
}
_KEYS: Final = ("name", *_PARTS, "leg", "legs", "controller")


def load_robot(name_or_path: str | Path) -> RobotDescription:
    """Read a robot description.

    Args:
        name_or_path: name of a shipped robot (``"lilibot"``) or path of a TOML file, whose keys
            are the fields of the parts in ``robot.model``; angles are in degrees.

    Raises:
        RobotDescriptionError: the file is missing, is no TOML, or holds a value out of range.
    """
    path = _find(str(name_or_path))
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise RobotDescriptionError(f"robot file {path}: not readable as TOML ({error})") from error
    try:
        return _robot(data)
    except RobotDescriptionError as error:
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


def _robot(data: Table) -> RobotDescription:
    _refuse_others(data, _KEYS)
    shared, each = _table(data, "leg"), data.get("legs")
    if not (isinstance(each, list) and each and all(isinstance(own, dict) for own in each)):
        raise NotAllowedError("legs", each, "a list of tables, at least one")
    legs = tuple(_leg(shared, own, f"legs[{i}].") for i, own in enumerate(each, start=1))
    parts: dict[str, Any] = {name: _inside(part, data, name) for name, part in _PARTS.items()}
    return RobotDescription(
        name=data.get("name", ""), legs=legs, controller=_table(data, "controller"), **parts
    )


def _table(data: Table, key: str) -> Table:
    value = data.get(key, {})
    if not isinstance(value, dict):
        raise NotAllowedError(key, value, "a table")
    return value


def _leg(shared: Table, own: Table, path: str) -> Leg:
    """A leg: what ``[leg]`` says, but for what its own table in ``[[legs]]`` says."""
    own = dict(own)
    if isinstance(own.get("hip"), list):  # an older name of the mount
        own["mount"] = own.pop("hip")
    merged = dict(shared)
    for key, value in own.items():
        both = isinstance(value, dict) and isinstance(shared.get(key), dict)
        merged[key] = {**shared[key], **value} if both else value
    try:
        return _read(Leg, merged)
    except NotAllowedError as error:
        first = error.name.split(".")[0]
        raise error.under(path if first in own or first in ("name", "mount") else "leg.") from None


def _read(part: type[Part], table: Table) -> Part:
    """Make a part of a table: every key a field, every field without a default a key."""
    values: dict[str, Any] = {}
    known: set[str] = set()
    hints, rule_of = get_type_hints(part, include_extras=True), rules(part)
    for entry in fields(part):  # type: ignore[arg-type]  # every part is a dataclass
        name = entry.name
        if FLAT in getattr(hints[name], "__metadata__", ()):
            inner = hints[name].__origin__
            keys = {f.name for f in fields(inner)}
            known |= keys
            values[name] = _read(inner, {key: table[key] for key in keys & table.keys()})
            continue
        known.add(name)
        if name not in rule_of:
            values[name] = _inside(hints[name], table, name)
        elif name in table:
            values[name] = _value(table[name], rule_of[name].unit)
        elif entry.default is MISSING:
            raise NotAllowedError(name, None, rule_of[name].allowed)
    _refuse_others(table, known)
    try:
        return part(**values)
    except NotAllowedError as error:
        raise NotAllowedError(error.name, table[error.name], error.allowed) from None


def _inside(part: type[Part], table: Table, key: str) -> Part:
    try:
        return _read(part, _table(table, key))
    except NotAllowedError as error:
        raise error.under(f"{key}.") from None


def _value(value: object, unit: str) -> object:
    """A number or numbers as the object has them; anything else is left for the check."""
    if isinstance(value, list):
        return tuple(_value(item, unit) for item in value)
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    return math.radians(value) if unit == "deg" else float(value)


def _refuse_others(table: Table, known: Collection[str]) -> None:
    for key in table:
        if key not in known:
            raise NotAllowedError(key, table[key], f"only {', '.join(sorted(known))}")
