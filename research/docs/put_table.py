"""Put the table of a study into a page of the documentation, in place of the one that stands there.

python -m research.docs.put_table docs/formation/walks.md apnc-study-gait/gait.md

The page has a line ``<!-- gait -->``, named as the file, directly above the table; a file with
several tables gives the first one.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from research.docs.manifest import measured_at, note, robots_in

TABLE = r"(?:\|.*\n)+"


def put(page: str, name: str, text: str) -> str:
    """The page with the first table of the text below its mark.

    Raises:
        ValueError: the page has no such mark with a table, or the text no table.
    """
    new = re.search(TABLE, text)
    if new is None:
        raise ValueError(f"{name}: no table")
    mark = re.escape(f"<!-- {name} -->\n")
    changed, count = re.subn(f"({mark}){TABLE}", lambda found: found[1] + new[0], page)
    if count != 1:
        raise ValueError(f"the mark '<!-- {name} -->' above a table is there {count} times")
    return changed


def main(page: Path, table: Path) -> None:
    """Change the page."""
    try:
        changed = put(page.read_text("utf-8"), table.stem, table.read_text("utf-8"))
    except ValueError as error:
        sys.exit(f"{page}: {error}")
    page.write_text(changed, encoding="utf-8")
    folder = table.parent
    note(robots_in(folder / "trials.csv"), table.stem, at=measured_at(folder))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
