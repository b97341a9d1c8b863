"""Pages on how far the gait carries: robustness, basin, limits of the claim.

    python -m research.docs.reach keep apnc-research-robustness
    python -m research.docs.reach

``keep`` counts the results in the folder of a study, writes the counts to ``docs/data``, and says
at which commit and on which robots they were measured. Without the word tables and pictures are
made from the files; pictures need Chromium.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from apnc.studies.table import markdown
from research import limits, robustness
from research.basin import ends, pushes
from research.docs import DOCS
from research.docs.manifest import entries, measured_at, name_of, note, robots_in
from research.docs.put_table import put
from research.docs.reach_pictures import draw
from research.robustness import numbers

Row = dict[str, Any]

TABLE_FILE: Final = "trials.csv"


class Kept(NamedTuple):
    """What is kept of a study.

    Args:
        page: page of its tables, below ``docs``.
        counts: function from results to rows.
        tables: function from rows to a table, by the mark above it.
    """

    page: str
    counts: Callable[[Sequence[Mapping[str, Any]]], list[Row]]
    tables: Mapping[str, Callable[[Sequence[Row]], str]]


STUDIES: Final[Mapping[str, Kept]] = {
    "robustness": Kept(
        "robustness.md",
        robustness.counts,  # type: ignore[arg-type]  # results are dictionaries
        {"robustness": robustness.counts_table},
    ),
    "robustness.numbers": Kept(
        "robustness.md",
        numbers.counts,  # type: ignore[arg-type]
        {"robustness-numbers": numbers.counts_table},
    ),
    "basin": Kept("basin.md", ends.counts, {"basin": ends.counts_table}),
    "basin.pushes": Kept(
        "basin.md",
        pushes.counts,  # type: ignore[arg-type]
        {"basin-pushes": pushes.counts_table},
    ),
    "limits": Kept(
        "limits_of_the_claim.md",
        limits.counts,  # type: ignore[arg-type]
        {
            "limits-works": limits.counts_table,
            "limits-upright": lambda rows: limits.counts_table(rows, "upright"),
        },
    ),
}
"""By name of the study."""


def data_of(name: str) -> Path:
    """File of the counts of a study."""
    return DOCS / "data" / f"reach_{name.replace('.', '_')}.csv"


def typed(text: str) -> Any:
    """A value of a table as what it was before it was written."""
    if text in ("", "True", "False"):
        return {"": None, "True": True, "False": False}[text]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def read(path: Path) -> list[Row]:
    """Rows of a CSV file."""
    with path.open(encoding="utf-8", newline="") as file:
        return [{name: typed(text) for name, text in row.items()} for row in csv.DictReader(file)]


def write(path: Path, rows: Sequence[Row]) -> None:
    """Write rows as CSV."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def keep(folder: Path) -> None:
    """Count the results of a study and write the counts, their size and their entries."""
    results = read(folder / TABLE_FILE)
    (name,) = {result["study"] for result in results}
    write(data_of(name), STUDIES[name].counts(results))
    seconds = sorted({float(result["duration"]) for result in results if result.get("duration")})
    note(
        robots_in(folder / TABLE_FILE),
        data_of(name),
        *STUDIES[name].tables,
        size_of(STUDIES[name].page),
        at=measured_at(folder),
        walks=len(results),
        seconds=" and ".join(f"{each:g}" for each in seconds),
        seeds=len({result["seed"] for result in results}),
    )


def size_of(page: str) -> str:
    """Mark of the table of how much was walked for a page."""
    return f"{Path(page).stem}-size"


def sizes_table(page: str) -> str:
    """A line per study of a page: how much was walked for it."""
    found = {
        name: entries()[name_of(data_of(name))]
        for name, study in STUDIES.items()
        if study.page == page
    }
    return markdown(
        {
            "`python -m research.`": f"`{name}`",
            "robot": ", ".join(entry["robots"]),
            "walks": f"{entry['walks']:,}",
            "length of a walk [s]": entry["seconds"],
            "seeds": str(entry["seeds"]),
            "commit": entry["commit"],
        }
        for name, entry in found.items()
    )


def write_pages() -> None:
    """Put all tables below their marks."""
    for page in dict.fromkeys(study.page for study in STUDIES.values()):
        path = DOCS / page
        text = put(path.read_text("utf-8"), size_of(page), sizes_table(page))
        for name, study in STUDIES.items():
            if study.page == page:
                rows = read(data_of(name))
                for mark, table in study.tables.items():
                    text = put(text, mark, table(rows))
        path.write_text(text, encoding="utf-8")


def main(words: Sequence[str]) -> None:
    """Keep the results of a study, or write pages and pictures."""
    if words[:1] == ["keep"]:
        for folder in words[1:]:
            keep(Path(folder))
    else:
        write_pages()
        draw({name: read(data_of(name)) for name in STUDIES})


if __name__ == "__main__":
    main(sys.argv[1:])
