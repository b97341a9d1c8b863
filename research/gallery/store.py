"""Files of the gallery: what was imported and tuned, and what was measured."""

from __future__ import annotations

import csv
import gzip
import io
import json
import re
from collections.abc import Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, Final

from pydantic import TypeAdapter

from research.docs import DOCS
from research.gallery.measure import Walk

WALKS: Final = DOCS / "data" / "gallery.csv.gz"
"""Every walk that was measured."""

ABOUT: Final = DOCS / "data" / "gallery.json"
"""What was measured, and how."""

NOTES: Final = "gallery.json"
"""Beside robot files: what is known of each, by name of the robot."""

_TUNED_BY: Final = re.compile(
    r"^# Tuned by apnc tune (?:\S*/)?(\S+)( --candidates (\d+) .*), version", re.MULTILINE
)

Notes = dict[str, dict[str, Any]]


def notes_in(folder: Path) -> Notes:
    """What is known of the robots of a folder; nothing if the folder has no notes."""
    file = folder / NOTES
    found: Notes = read_json(file) if file.is_file() else {}
    return found


def add_note(folder: Path, name: str, note: dict[str, Any]) -> None:
    """Write what is known of a robot, at once: the next one may take long."""
    write_json(folder / NOTES, notes_in(folder) | {name: note})


def searches_of(robot_file: Path) -> dict[str, Any]:
    """What a tuned robot file says of its searches.

    Returns:
        ``commands`` that find it again, one after the other, and how many ``candidates`` they try;
        nothing for a file that ``apnc tune`` did not write.
    """
    # a search that began with a tuned file has written its line above that of the one before
    found = _TUNED_BY.findall(robot_file.read_text("utf-8"))[::-1]
    if not found:
        return {}
    commands = [f"apnc tune {name}{options}" for name, options, _ in found]
    for index, (name, _, _) in enumerate(found[1:]):
        commands[index] += f" --output {name}"
    return {"commands": commands, "candidates": sum(int(count) for *_, count in found)}


def read_json(file: Path) -> Any:
    """Read plain data."""
    return json.loads(file.read_text("utf-8"))


def write_json(file: Path, content: Any) -> None:
    """Write plain data."""
    file.write_text(json.dumps(content, indent=1, sort_keys=True) + "\n", encoding="utf-8")


def write_walks(file: Path, walks: Sequence[Walk]) -> None:
    """Write walks as compressed CSV, the same bytes for the same walks."""
    text = io.StringIO()
    table = csv.DictWriter(text, [field.name for field in fields(Walk)], lineterminator="\n")
    table.writeheader()
    for walk in walks:
        table.writerow({name: _short(value) for name, value in asdict(walk).items()})
    file.write_bytes(gzip.compress(text.getvalue().encode(), mtime=0))


def read_walks(file: Path) -> list[Walk]:
    """Walks that were written."""
    with gzip.open(file, "rt", encoding="utf-8", newline="") as stream:
        rows = [
            {name: value or None for name, value in row.items()} for row in csv.DictReader(stream)
        ]
    return TypeAdapter(list[Walk]).validate_python(rows)


def _short(value: object) -> object:
    return f"{value:.6g}" if isinstance(value, float) else value
