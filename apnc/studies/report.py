"""The files of a study besides its results: CSV table, HTML report, claims, Markdown tables."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Final, NamedTuple

from apnc.controllers import named_controller
from apnc.loop.provenance import what_was_run
from apnc.report.figure import Figure
from apnc.report.html import page
from apnc.studies.claims import FEW, Claim, Judgement, judgements
from apnc.studies.machine import commit, processor
from apnc.studies.plots import CRITERIA
from apnc.studies.results import Result, columns_of, controllers_in, id_of, matching
from apnc.studies.study import Study, Trial, load
from apnc.studies.table import markdown
from build_fmu.writing import Write

TABLE_FILE: Final = "trials.csv"


class Statement(NamedTuple):
    """A statement of what was measured, taken apart for a table.

    Args:
        criterion: by which the gait has formed: strict, authors' or empty.
        numbers: what is stated, or the two sides that are compared.
        test: how sure it is: number of runs, p, size of the effect.
    """

    criterion: str
    numbers: list[str]
    test: list[str]


class Part(NamedTuple):
    """Contents of the report for one study.

    ``needs`` says for each claim what is missing for a verdict; empty if there is one.
    """

    study: Study
    facts: list[tuple[str, str]]
    claims: list[tuple[Claim, Judgement]]
    needs: list[str]
    failed: list[tuple[str, str]]
    figures: list[Figure]


def files_of(
    grid: Sequence[Trial], results: Sequence[Result], wall_s: float, *, scenes: bool
) -> dict[str, Write]:
    """Functions that write the files of a study, by name of the file.

    Args:
        grid: trials of the study.
        results: results of those that were run.
        wall_s: wall time of these trials [s].
        scenes: run single experiments and draw them over time.
    """
    parts = [
        part_of(load(entry), [trial for trial in grid if trial.entry == entry], own, scenes)
        for entry in dict.fromkeys(trial.entry for trial in grid)
        if (own := matching(results, study=entry.name))
    ]
    facts = _facts(grid, results, wall_s)
    texts = {
        "report.html": page(
            "study.html.j2",
            [figure for part in parts for figure in part.figures],
            package="apnc.studies",
            parts=parts,
            facts=facts,
            statements=statements,
        ),
        "claims.md": claims_markdown(parts, facts),
    }
    for part in parts:
        if part.study.table is not None:
            own = matching(results, study=part.study.name)
            texts[f"{part.study.name}.md"] = part.study.table(own)
    files: dict[str, Write] = {TABLE_FILE: partial(write_table, results)}
    for name, text in texts.items():
        files[name] = partial(Path.write_text, data=text, encoding="utf-8")
    return files


def part_of(study: Study, grid: Sequence[Trial], results: Sequence[Result], scenes: bool) -> Part:
    """Contents of the report for one study.

    Args:
        study: the study.
        grid: its trials.
        results: results of those that were run.
        scenes: run single experiments and draw them over time.
    """
    commands = {trial.id: trial.experiment.command() for trial in grid}
    failed = [
        (result["error"] or result["end"], commands[id_of(result)])
        for result in results
        if result["end"] != "complete"
    ]
    shown = study.scenes(grid[0].experiment.robot) if scenes else []
    figures = [*study.figures(results), *shown]
    claims = judgements(results, study.claims)
    needs = [_needs(results, *claim) for claim in claims]
    return Part(study, _asked(study, grid, results), claims, needs, failed, figures)


def _needs(results: Sequence[Result], claim: Claim, found: Judgement) -> str:
    """What is missing for a verdict on a claim; empty if there is one."""
    if found.verdict != FEW:
        return ""
    seeds = min(
        len({result["seed"] for result in matching(results, controller=controller)})
        for controller in claim.controllers
    )
    if seeds < claim.seeds:
        return f"needs {claim.seeds} seeds of each controller, has {seeds}"
    return "needs more runs that have the numbers"


def statements(measured: str) -> list[Statement]:
    """What was measured of a claim, a statement for each line of a table."""
    found, criterion = [], ""
    for item in measured.split("; "):
        if named := re.match(r"(strict|authors'): ", item):
            criterion, item = named[1], item[named.end() :]
        own, against, other = item.partition(" against ")
        said = other or own
        first, *rest = [said] if said.startswith("not run: ") else said.split(", ")
        if against and rest and rest[0].startswith("n = "):
            first = f"{first}, {rest.pop(0)}"
        numbers = [own, f"against {first}"] if against else [first]
        found.append(Statement(criterion, numbers, rest))
    return found


def _asked(study: Study, grid: Sequence[Trial], results: Sequence[Result]) -> list[tuple[str, str]]:
    """Facts of a study: robot, duration, controllers, seeds, and controllers that were not run."""
    run = controllers_in(results)
    controllers = "; ".join(_told(study, controller) for controller in run)
    if missing := [
        named_controller(controller).name
        for controller in study.controllers
        if controller not in run
    ]:
        controllers += f"; not run: {', '.join(missing)}"
    robots = sorted({trial.experiment.description.name for trial in grid})
    engines = sorted({trial.experiment.engine for trial in grid})
    spans = sorted({trial.experiment.duration for trial in grid})
    return [
        ("where", study.entry.section or "not in the paper"),
        ("robot", ", ".join(robots)),
        ("engine", ", ".join(engines)),
        ("duration", ", ".join(f"{span:g} s" for span in spans)),
        ("controllers", controllers),
        ("seeds", str(len({result["seed"] for result in results}))),
        ("trials", f"{len(results)} of {len(grid)}"),
        ("criteria", "; ".join(CRITERIA.values())),
    ]


def _told(study: Study, label: str) -> str:
    """Name of a controller and its settings in a study."""
    used = named_controller(label)
    return " ".join([used.name, *(f"{k}={v:g}" for k, v in used.settings_in(study.name).items())])


def _facts(
    grid: Sequence[Trial], results: Sequence[Result], wall_s: float
) -> list[tuple[str, str]]:
    versions = what_was_run(grid[0].experiment)["versions"]
    simulated = sum(result["duration"] for result in results)
    return [
        ("trials", f"{len(results)}, {simulated:.0f} s simulated in {wall_s / 60:.1f} min"),
        ("machine", processor()),
        ("commit", commit()),
        ("versions", ", ".join(f"{name} {version}" for name, version in versions.items())),
    ]


def claims_markdown(parts: Sequence[Part], facts: Sequence[tuple[str, str]]) -> str:
    """Claims with their verdicts as a Markdown table, below the facts."""
    head = "".join(f"- {name}: {text}\n" for name, text in facts)
    return f"{head}\n" + markdown(
        {
            "paper says": claim.text,
            "where": claim.section,
            "measured (median and 95 % interval)": found.measured,
            "verdict": f"**{found.verdict}**",
        }
        for part in parts
        for claim, found in part.claims
    )


def write_table(results: Sequence[Result], path: Path) -> None:
    """Write results as CSV, with a column for every entry that any of them has."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns_of(results), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(results)
