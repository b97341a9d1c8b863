"""What a study leaves in its folder: table, report, claims, and Markdown tables."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Final, NamedTuple

from apnc.loop.provenance import what_was_run
from apnc.report.figure import Figure
from apnc.report.folder import Write
from apnc.report.html import page
from apnc.studies.claims import Claim, Finding, findings
from apnc.studies.contenders import contender
from apnc.studies.machine import commit, processor
from apnc.studies.plots import CRITERIA
from apnc.studies.rows import Row, matching, methods_in
from apnc.studies.store import place_of
from apnc.studies.study import Study, Trial, load
from apnc.studies.table import markdown

TABLE_FILE: Final = "trials.csv"


class Part(NamedTuple):
    """What the report shows of one study."""

    study: Study
    facts: list[tuple[str, str]]
    claims: list[tuple[Claim, Finding]]
    failed: list[tuple[str, str]]
    figures: list[Figure]


def files_of(
    grid: Sequence[Trial], rows: Sequence[Row], wall_s: float, *, scenes: bool
) -> dict[str, Write]:
    """What writes each file of a study's folder, by its name.

    Args:
        grid: trials asked for.
        rows: of those that were run.
        wall_s: wall time that the rows took [s].
        scenes: run single experiments again to show them over time.
    """
    parts = [
        part_of(load(entry), [trial for trial in grid if trial.entry == entry], own, scenes)
        for entry in dict.fromkeys(trial.entry for trial in grid)
        if (own := matching(rows, study=entry.name))
    ]
    facts = _facts(grid, rows, wall_s)
    texts = {
        "report.html": page(
            "study.html.j2",
            [figure for part in parts for figure in part.figures],
            package="apnc.studies",
            parts=parts,
            facts=facts,
        ),
        "claims.md": claims_markdown(parts, facts),
    }
    for part in parts:
        if part.study.table is not None:
            own = matching(rows, study=part.study.name)
            texts[f"{part.study.name}.md"] = part.study.table(own)
    files: dict[str, Write] = {TABLE_FILE: partial(write_table, rows)}
    for name, text in texts.items():
        files[name] = partial(Path.write_text, data=text, encoding="utf-8")
    return files


def part_of(study: Study, grid: Sequence[Trial], rows: Sequence[Row], scenes: bool) -> Part:
    """What the report shows of the rows of one study."""
    commands = {trial.place: trial.experiment.command() for trial in grid}
    failed = [
        (row["error"] or row["end"], commands[place_of(row)])
        for row in rows
        if row["end"] != "complete"
    ]
    shown = study.scenes(grid[0].experiment.robot) if scenes else []
    figures = [*study.figures(rows), *shown]
    return Part(study, _asked(study, grid, rows), findings(rows, study.claims), failed, figures)


def _asked(study: Study, grid: Sequence[Trial], rows: Sequence[Row]) -> list[tuple[str, str]]:
    """Robot, duration, methods and seeds, and what was asked for and not run."""
    run = methods_in(rows)
    methods = "; ".join(_told(study, method) for method in run)
    if missing := [contender(method).name for method in study.methods if method not in run]:
        methods += f"; not run: {', '.join(missing)}"
    robots = sorted({trial.experiment.description.name for trial in grid})
    engines = sorted({trial.experiment.engine for trial in grid})
    spans = sorted({trial.experiment.duration for trial in grid})
    return [
        ("where", study.entry.place or "not in the paper"),
        ("robot", ", ".join(robots)),
        ("engine", ", ".join(engines)),
        ("duration", ", ".join(f"{span:g} s" for span in spans)),
        ("methods", methods),
        ("seeds", str(len({row["seed"] for row in rows}))),
        ("trials", f"{len(rows)} of {len(grid)}"),
        ("criteria", "; ".join(CRITERIA.values())),
    ]


def _told(study: Study, label: str) -> str:
    """Name of a contender and its settings."""
    used = contender(label)
    return " ".join([used.name, *(f"{k}={v:g}" for k, v in used.settings_in(study.name).items())])


def _facts(grid: Sequence[Trial], rows: Sequence[Row], wall_s: float) -> list[tuple[str, str]]:
    versions = what_was_run(grid[0].experiment)["versions"]
    simulated = sum(row["duration"] for row in rows)
    return [
        ("trials", f"{len(rows)}, {simulated:.0f} s simulated in {wall_s / 60:.1f} min"),
        ("machine", processor()),
        ("commit", commit()),
        ("versions", ", ".join(f"{name} {version}" for name, version in versions.items())),
    ]


def claims_markdown(parts: Sequence[Part], facts: Sequence[tuple[str, str]]) -> str:
    """The claims as a Markdown table."""
    head = "".join(f"- {name}: {text}\n" for name, text in facts)
    return f"{head}\n" + markdown(
        {
            "paper says": claim.text,
            "where": claim.place,
            "measured (median and 95 % interval)": found.measured,
            "verdict": f"**{found.verdict}**",
        }
        for part in parts
        for claim, found in part.claims
    )


def write_table(rows: Sequence[Row], path: Path) -> None:
    """Write rows as one tidy CSV with a column for every entry that any of them has."""
    columns = dict.fromkeys(name for row in rows for name in row)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(columns), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
