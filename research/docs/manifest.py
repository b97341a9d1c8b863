"""Ties every stored result of the documentation to the robots that it was measured on.

python -m research.docs.manifest                                        # names stale results
python -m research.docs.manifest keep apnc-study-all/trials.csv docs/data/evaluation.csv.gz
python -m research.docs.manifest note docs/robots/octopod.md octopod

``keep`` copies results into the documentation, compressed if the name ends with ``.gz``, and writes
their entry. ``note`` writes the entry of a file or page. The scripts that write tables, pictures
and films write the entries of these. Write entries with the code that measured the results.

``docs/data/manifest.json`` holds, for each result, the commit and a hash of the motion of each
robot. The motion is that of short walks, so the hash changes with the robot file, the defaults of
the controller and the laws of physics, and not with names or comments. The bits of a walk in C are
the same on every machine.
"""

from __future__ import annotations

import csv
import gzip
import hashlib
import json
import re
import sys
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, Final

from apnc.loop.experiment import Experiment
from apnc.many import simulate_many
from apnc.studies.machine import commit
from apnc_core.enumerations import ForwardModel
from apnc_plant.ground import Obstacles, Plane
from research.docs import DOCS

FILE: Final = DOCS / "data" / "manifest.json"

USUAL: Final = "lilibot"
"""Robot of a study whose results name none."""

Manifest = dict[str, dict[str, Any]]
"""Entries by file below ``docs``, or by mark of a table, such as ``table gait``.

An entry has ``commit`` and ``robots``, the hash of the motion by robot, and may say more. A result
of former robots, which the page shows as such, has ``former`` in place of them: a text that says
so.
"""


def walks(robot: str) -> list[Experiment]:
    """Short walks that use each method, forward model and condition of the studies."""
    usual: dict[str, Any] = {"robot": robot, "mi": 0.15, "seed": 1, "duration": 4.0}
    changes: list[dict[str, Any]] = [
        *({"controller": label} for label in ("apnc", "apc", "tegotae", "phase_reset")),
        *({"settings": {"forward_model": model}} for model in ForwardModel),
        *({"conditions": name} for name in ("C2", "C3", "C4", "S1", "S2", "S3")),
        {"ground": Obstacles(roughness=0.8, seed=1)},
        {"ground": Plane(slope=0.05)},
        {"rate": 30.0},
        {"turn": 0.5},
        {"mi": ((0.0, 0.4), (2.0, 0.0))},
    ]
    return [Experiment(engine="compiled", **{**usual, **change}) for change in changes]


@cache
def motion(robot: str) -> str:
    """Hash of the motion of a shipped robot, its loads and its commands, 12 hex digits."""
    found = hashlib.sha256()
    for record in simulate_many(walks(robot), records=True):
        assert record is not None
        for name in ("position", "joint_angle", "grf", "theta_hip", "theta_knee"):
            found.update(record.signals[name].tobytes())
    return found.hexdigest()[:12]


def entries() -> Manifest:
    """The manifest as it is stored."""
    found: Manifest = json.loads(FILE.read_text("utf-8"))
    return found


def note(robots: Iterable[str], *results: Path | str, at: str = "", **more: Any) -> None:
    """Write the entries of results that were measured with the present code.

    Args:
        robots: names of the shipped robots that they were measured on.
        results: files or pages below ``docs``, or marks of tables.
        at: commit at which they were measured; the present one if omitted.
        more: further values of the entry, such as how much was walked.
    """
    moved = {robot: motion(robot) for robot in sorted(set(robots))}
    entry = {"commit": at or commit(), "robots": moved, **more}
    names = [name_of(result) for result in results]
    text = json.dumps(entries() | dict.fromkeys(names, entry), indent=1, sort_keys=True)
    FILE.write_text(text + "\n", encoding="utf-8")


def name_of(result: Path | str) -> str:
    """Name of a file, page or mark in the manifest."""
    if isinstance(result, str):
        return f"table {result}"
    return result.resolve().relative_to(DOCS).as_posix()


def stale() -> dict[str, list[str]]:
    """Names of the results that today's robots would not give, with the robots that changed."""
    changed = {
        name: [robot for robot, found in entry["robots"].items() if found != motion(robot)]
        for name, entry in entries().items()
        if "robots" in entry
    }
    return {name: robots for name, robots in changed.items() if robots}


def robots_in(trials: Path) -> set[str]:
    """Names of the robots in the file ``trials.csv`` of a study, ``USUAL`` if there is no file."""
    if not trials.is_file():
        return {USUAL}
    with trials.open(newline="", encoding="utf-8") as file:
        return {line.get("robot") or USUAL for line in csv.DictReader(file)}


def measured_at(folder: Path) -> str:
    """Commit that the report in the folder of a study names; the present one if none does."""
    for path in sorted(folder.glob("*.md")):
        if found := re.search(r"^- commit: (\S+)$", path.read_text("utf-8"), re.MULTILINE):
            return found[1]
    return commit()


def keep(trials: Path, target: Path) -> None:
    """Copy the file ``trials.csv`` of a study into the documentation, and write its entry."""
    content = trials.read_bytes()
    if target.suffix == ".gz":
        content = gzip.compress(content, mtime=0)
    target.write_bytes(content)
    note(robots_in(trials), target, at=measured_at(trials.parent))


def main(words: Sequence[str]) -> None:
    """Copy results, write an entry, or name the results that are stale."""
    if words[:1] == ["keep"]:
        keep(*map(Path, words[1:]))
    elif words[:1] == ["note"]:
        note(words[2:], Path(words[1]))
    elif found := stale():
        lines = (f"{name}: {', '.join(robots)} changed" for name, robots in found.items())
        sys.exit("\n".join(lines))


if __name__ == "__main__":
    main(sys.argv[1:])
