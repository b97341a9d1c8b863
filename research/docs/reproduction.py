"""Put the verdicts on the paper's claims into reproduction.md, and their figures beside it.

python -m research.docs.reproduction apnc-study-all/claims.md apnc-research-symmetry/claims.md

The table of verdicts goes into ``docs/reproduction.md``, how many claims have which verdict also
into the sentences of ``COUNTED``; what was measured goes into ``docs/reproduction/claims.md``,
which is written as a whole. The words are in ``reasons.toml``. A claim without an entry there, an
entry without a claim, or another verdict than the words were written for stops it: words are
written after looking at the figures, not carried along.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from research.docs import DOCS
from research.docs.manifest import note, robots_in
from research.docs.put_table import put

PAGE: Final = DOCS / "reproduction.md"
DETAILS: Final = DOCS / "reproduction" / "claims.md"
REASONS: Final = Path(__file__).with_name("reasons.toml")
COUNTED: Final = (DOCS.parent / "README.md", DOCS / "index.md", DOCS / "limits.md")
"""Pages with a sentence that counts the verdicts, as ``sentence`` makes it."""
YES: Final = "reproduced"
VERDICTS: Final = (YES, "partly", "not", "no verdict")

HEAD: Final = """# Claim by claim

<!-- written by research.docs.reproduction -->

What each claim says, its verdict, the reason, and what was measured. [The paper's
claims](../reproduction.md) says how they are judged and what the settings of the baselines are; the
[figures](figures.md) show the runs.

A time or speed is a median with its 95 % interval in brackets. *n* counts the runs that have the
value; "-" means that none has. *rho* is Spearman's rank correlation, *p* the probability of the
difference by chance, and *r* the rank-biserial effect.
"""


class Verdict(NamedTuple):
    """A claim, what was measured, and what the page says of it."""

    claim: str
    where: str
    measured: str
    verdict: str
    short: str
    why: str


def verdicts(claims: str, reasons: Sequence[dict[str, str]]) -> list[Verdict]:
    """Claims of the tables of studies with the words for each.

    Raises:
        ValueError: a claim has no words or another verdict than they were written for, or words
            have no claim.
    """
    words = {(entry["where"], entry["claim"]): entry for entry in reasons}
    found = []
    for line in claims.splitlines():
        row = re.fullmatch(r"\| (.*?) \| (.*?) \| (.*) \| \*\*(.*)\*\* \|", line)
        if row is None:
            continue
        claim, where, measured, verdict = row.groups()
        entry = words.pop((where, claim), None)
        if entry is None or entry["verdict"] != verdict:
            state = "no words" if entry is None else f"words for '{entry['verdict']}'"
            raise ValueError(f"'{claim}' ({where}) is '{verdict}': {REASONS.name} has {state}")
        why = " ".join(entry.get("why", "").split())
        if bool(why) == (verdict == YES):
            state = "is left over" if why else "is missing"
            raise ValueError(f"'{claim}' ({where}) is '{verdict}': its reason {state}")
        found.append(Verdict(claim, where, measured, verdict, entry["short"], why))
    if words:
        raise ValueError(f"{REASONS.name}: no such claims: {sorted(words)}")
    return found


def table(found: Sequence[Verdict]) -> str:
    """The table of verdicts, each claim with a link to its figures."""
    lines = ["| claim, and where in the paper | verdict | in short |", "|---|---|---|"]
    for number, each in enumerate(found, start=1):
        link = f"[{each.claim}](reproduction/claims.md#claim-{number})"
        lines.append(f"| {link} ({each.where}) | **{each.verdict}** | {each.short} |")
    return "\n".join(lines) + "\n"


def counts(found: Sequence[Verdict]) -> str:
    """How many claims have which verdict."""
    count = Counter(each.verdict for each in found)
    shown = [verdict for verdict in VERDICTS if count[verdict]]
    return "\n".join((
        f"| {' | '.join(shown)} | all |",
        "|---" * (len(shown) + 1) + "|",
        f"| {' | '.join(str(count[verdict]) for verdict in shown)} | {len(found)} |",
        "",
    ))  # fmt: skip


def sentence(found: Iterable[str]) -> str:
    """How many claims have which verdict, of the verdict on each, for the middle of a sentence."""
    count = Counter(found)
    return (
        f"{count.total()} claims that a simulation can check: {count[YES]} reproduced, "
        f"{count['partly']} partly, {count['not']} not, {count['no verdict']} without a verdict"
    )


def put_sentence(page: str, text: str) -> str:
    """The page with its sentence that counts the verdicts replaced.

    Raises:
        ValueError: the page does not have it once.
    """
    pattern = re.sub(r"\d+", r"\\d+", text)
    changed, times = re.subn(pattern, text, page)
    if times != 1:
        raise ValueError(f"the sentence '{text}' is there {times} times")
    return changed


FOLDED: Final = '<details markdown="1">\n<summary>What was measured</summary>\n\n'
"""Begin of a part of a page that a click unfolds."""


def details(found: Sequence[Verdict]) -> str:
    """The page of what was measured, a section per claim."""
    parts = [HEAD]
    for number, each in enumerate(found, start=1):
        heading = each.claim[:1].upper() + each.claim[1:]
        parts.append(f'\n## <a id="claim-{number}"></a>{heading}\n\n')
        parts.append(f"**{each.verdict}** · {each.where}\n\n")
        if each.why:
            parts.append(f"{each.why}\n\n")
        parts.append(f"{FOLDED}{measured(each.measured)}\n</details>\n")
    return "".join(parts)


def measured(text: str) -> str:
    """What was measured as a list, an item for each statement; criteria have lists of their own."""
    lines, indent = [], ""
    for item in text.split("; "):
        criterion = re.match(r"(strict|authors'): ", item)
        if criterion:
            lines.append(f"- By the {criterion[1]} criterion:")
            indent, item = "    ", item[criterion.end() :]
        lines.append(f"{indent}- {item}")
    return "\n".join(lines) + "\n"


def main(paths: Sequence[Path]) -> None:
    """Rewrite the tables of the page, and the page of details."""
    reasons = tomllib.loads(REASONS.read_text("utf-8"))["reason"]
    try:
        found = verdicts("\n".join(path.read_text("utf-8") for path in paths), reasons)
        page = put(PAGE.read_text("utf-8"), "verdict-counts", counts(found))
        page = put(page, "claims", table(found))
        told = sentence(each.verdict for each in found)
        counted = {path: put_sentence(path.read_text("utf-8"), told) for path in COUNTED}
    except ValueError as error:
        sys.exit(str(error))
    PAGE.write_text(page, encoding="utf-8")
    DETAILS.write_text(details(found), encoding="utf-8")
    for path, text in counted.items():
        path.write_text(text, encoding="utf-8")
    robots = {robot for path in paths for robot in robots_in(path.with_name("trials.csv"))}
    note(robots, "verdict-counts", "claims", DETAILS)


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:]])
