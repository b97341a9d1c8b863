"""Measure ``docs/data/verdicts.csv`` and put its table into ``docs/reproduction/seeds.md``.

nice python -m research.docs.verdicts [measure [WORKERS]]

The studies of ``apnc study all`` with ten groups of 20 seeds, and the verdict on every claim from
each group alone. Without the word the table is written from the file. Measuring takes five to ten
minutes on two cores.
"""

from __future__ import annotations

import csv
import sys
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from apnc.studies.claims import NO, PARTLY, YES, judgements
from apnc.studies.registry import ALL, STUDIES, names_of
from apnc.studies.results import Result
from apnc.studies.runner import run_trials
from apnc.studies.study import Trial, load
from apnc.studies.table import markdown
from research.docs import DOCS
from research.docs.manifest import USUAL, note
from research.docs.put_table import put

FILE: Final = DOCS / "data" / "verdicts.csv"
PAGE: Final = DOCS / "reproduction" / "seeds.md"

GROUPS: Final = 10
SEEDS: Final = 20


def trials_of(name: str) -> list[Trial]:
    """The grid of a study as with 20 trials, once with each group of seeds."""
    study = load(STUDIES[name])
    every = replace(study, seeds=lambda cell, trials: trials if study.seeds(cell, SEEDS) else 0)
    return [
        trial
        for trial in every.grid(GROUPS * SEEDS)
        if trial.cell["seed"] % SEEDS < study.seeds(trial.cell, SEEDS)
    ]


def measured(workers: int) -> Iterator[dict[str, str]]:
    """A line per claim and group of seeds."""
    for name in names_of(ALL):
        groups: dict[int, list[Result]] = defaultdict(list)
        for result in run_trials(trials_of(name), workers=workers):
            groups[result["seed"] // SEEDS].append(result)
        for group, results in sorted(groups.items()):
            for claim, found in judgements(results, load(STUDIES[name]).claims):
                yield {
                    "seeds": f"{group * SEEDS} to {group * SEEDS + SEEDS - 1}",
                    "where": claim.section,
                    "claim": claim.text,
                    "verdict": found.verdict,
                }
        print(name, flush=True)


def table(lines: list[dict[str, str]]) -> str:
    """The claims whose verdict is not the same in every group, and how often it is which."""
    verdicts: dict[tuple[str, str], list[str]] = defaultdict(list)
    for line in lines:
        verdicts[line["claim"], line["where"]].append(line["verdict"])
    return markdown(
        {"claim": claim, "where": where, f"seeds {lines[0]['seeds']}": found[0]}
        | {verdict: str(found.count(verdict)) for verdict in (YES, PARTLY, NO)}
        for (claim, where), found in verdicts.items()
        if len(set(found)) > 1
    )


def main(words: list[str]) -> None:
    """Measure if asked to, and write the page."""
    if words[:1] == ["measure"]:
        lines = list(measured(int(words[1]) if len(words) > 1 else 1))
        with FILE.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, list(lines[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(lines)
        note({USUAL}, FILE)
    with FILE.open(encoding="utf-8") as file:
        text = put(PAGE.read_text("utf-8"), "verdicts", table(list(csv.DictReader(file))))
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
