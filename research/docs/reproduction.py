"""Put a new table of claims into reproduction.md, each with its reason from reasons.toml.

python -m research.docs.reproduction apnc-study-all/claims.md apnc-research-symmetry/claims.md

A claim that is not reproduced and has no reason, or a reason whose claim is gone or was reproduced,
stops it: reasons are written after looking at the figures, not carried along.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path

from research.docs import DOCS

HEAD = "| paper says | where | measured (median and 95 % interval) | verdict | why |"


def table(claims: str, reasons: dict[tuple[str, str], str]) -> list[str]:
    """Lines of the table, the column ``why`` added."""
    lines, used = [HEAD, "|---|---|---|---|---|"], set()
    for line in claims.splitlines():
        row = re.fullmatch(r"\| (.*?) \| (.*?) \| (.*) \| \*\*(.*)\*\* \|", line)
        if row is None:
            continue
        text, place, _, verdict = row.groups()
        why = reasons.get((place, text), "")
        if (verdict == "reproduced") == bool(why):
            sys.exit(
                f"'{text}' ({place}) is '{verdict}': reason {'left over' if why else 'missing'}"
            )
        used.add((place, text))
        lines.append(f"{line} {why} |")
    if unknown := set(reasons) - used:
        sys.exit(f"reasons without a claim: {sorted(unknown)}")
    return lines


def main(claims: Sequence[Path]) -> None:
    """Rewrite the table of reproduction.md."""
    with Path(__file__).with_name("reasons.toml").open("rb") as file:
        entries = tomllib.load(file)["reason"]
    reasons = {(e["where"], e["claim"]): " ".join(e["why"].split()) for e in entries}
    page = DOCS / "reproduction.md"
    before, after = re.split(r"(?m)^\| paper says .*\n(?:\|.*\n)*", page.read_text("utf-8"))
    new = "\n".join(table("".join(path.read_text("utf-8") for path in claims), reasons)) + "\n"
    page.write_text(before + new + after, encoding="utf-8")


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:]])
