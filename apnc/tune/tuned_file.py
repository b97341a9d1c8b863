"""The robot file of a candidate: that of the robot, with what was changed and nothing else."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

from apnc.extras import missing
from apnc_core.interface import Parameters
from apnc_plant.robot import ROBOTS, RobotDescription, load_robot

DIGITS: Final = 5
"""Significant digits of a number that was searched."""

_ANGLES: Final = ("femur_angle", "tibia_angle", "pointing", "offset")
"""Keys of a leg and its joints that a file gives in degrees."""


def tuned_text(file: str | Path, robot: RobotDescription, comments: Sequence[str]) -> str:
    """Text of the robot file with the numbers of another robot; comments and order are kept.

    Args:
        file: the robot file, or the name of a shipped robot.
        robot: a robot that differs from that of the file in numbers only.
        comments: lines to put in front.

    Raises:
        RuntimeError: the package ``tomlkit`` is missing.
    """
    try:
        import tomlkit  # noqa: PLC0415  # an extra
    except ModuleNotFoundError:
        raise RuntimeError(missing("tomlkit", "tune")) from None
    document: Any = tomlkit.parse(path_of(file).read_text(encoding="utf-8"))
    present = load_robot(file)
    legs = {table["name"]: table for table in document["legs"]}
    for (first, *rest), _, value in changes(present, robot):
        if first == "legs":
            table, rest = legs[rest[0]], rest[1:]
            common = document.get("leg", {})
        elif not rest:
            document[first] = value
            continue
        else:
            table, common = document.setdefault(first, tomlkit.table()), {}
        for name in rest[:-1]:
            table, common = table.setdefault(name, tomlkit.table()), common.get(name, {})
        if rest[-1] in table or common.get(rest[-1]) != value:
            table[rest[-1]] = value
    text: str = tomlkit.dumps(document)
    return "".join(f"# {line}\n" for line in comments) + "\n" + text


def path_of(file: str | Path) -> Path:
    """Path of a robot file, also of a shipped robot."""
    shipped = ROBOTS / f"{file}.toml"
    return shipped if shipped.exists() else Path(file)


def read_back(text: str) -> RobotDescription:
    """The robot of a text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.toml")
        path.write_text(text, encoding="utf-8")
        return load_robot(path)


class Change(NamedTuple):
    """A number that differs between two robots, as a file has it.

    Args:
        place: its table and key, e.g. ``("legs", "RF", "femur_angle")``.
        old: what it was; what holds without a number of the file, if the file had none.
        new: what it is.
    """

    place: tuple[str, ...]
    old: Any
    new: Any


def changes(before: Any, after: Any) -> Iterator[Change]:
    """What differs between two robots or parts."""
    for each in fields(after):
        old, new = getattr(before, each.name), getattr(after, each.name)
        if old == new:
            continue
        if is_dataclass(new) and type(old) is type(new):
            inside = list(changes(old, new))
        elif each.name == "legs":
            inside = [
                change._replace(place=(leg.name, *change.place))
                for was, leg in zip(old, new, strict=True)
                for change in changes(was, leg)
            ]
        elif each.name == "controller":
            default = Parameters()
            inside = [
                Change((name,), old.get(name, getattr(default, name)), _rounded(value))
                for name, value in new.items()
                if old.get(name) != value
            ]
        else:
            if each.name in _ANGLES:
                old, new = math.degrees(old), math.degrees(new)
            yield Change((each.name,), _rounded(old), _rounded(new))
            continue
        yield from (change._replace(place=(each.name, *change.place)) for change in inside)


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, tuple):
        return [_rounded(entry) for entry in value]
    return value
