"""Put the aims of ``apnc study gait``, and whether they are met, into ``docs/formation.md``.

python -m research.docs.aims apnc-study-gait/claims.md
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Final

from research.docs import DOCS
from research.docs.manifest import note, robots_in
from research.docs.put_table import put

PAGE: Final = DOCS / "formation.md"
MET: Final = {"reproduced": "yes", "partly": "partly", "not": "no"}


def table(claims: str) -> str:
    """The aims among the claims of a study, the verdict in words that fit an aim.

    Raises:
        ValueError: no aim is among them.
    """
    found = re.findall(r"(?m)^\| (.*?) \| aim \| (.*) \| \*\*(.*)\*\* \|$", claims)
    if not found:
        raise ValueError("no aims in this file of claims")
    lines = [
        f"| {aim} | **{MET.get(verdict, verdict)}** | {text} |" for aim, text, verdict in found
    ]
    return "\n".join(["| aim | reached | measured |", "|---|---|---|", *lines]) + "\n"


def main(claims: Path) -> None:
    """Change the page."""
    try:
        page = put(PAGE.read_text("utf-8"), "aims", table(claims.read_text("utf-8")))
    except ValueError as error:
        sys.exit(f"{claims}: {error}")
    PAGE.write_text(page, encoding="utf-8")
    note(robots_in(claims.with_name("trials.csv")), "aims")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
