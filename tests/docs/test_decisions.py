"""The pages of decisions keep their form, are listed, and name files that exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "decisions"
INDEX = FOLDER / "index.md"
DECISIONS = sorted(set(FOLDER.glob("*.md")) - {INDEX, FOLDER / "template.md"})
NAMING_FILES = [*DECISIONS, ROOT / "docs" / "glossary.md"]

STATUS = re.compile(r"\AStatus: (accepted|superseded by \[[^]]+\]\(([a-z0-9-]+\.md)\))\Z")
NAMED_FILE = re.compile(r"`([\w-]+(?:/[\w-]+)*/[\w-]+\.(?:py|c|h|toml))`")


@pytest.mark.parametrize("page", DECISIONS, ids=lambda p: p.stem)
def test_a_decision_has_status_context_decision_and_consequence(page: Path) -> None:
    text = page.read_text("utf-8")
    title, status, *_ = text.split("\n\n")
    assert title.startswith("# ")
    assert STATUS.match(status), status
    assert re.findall("^## (.*)$", text, re.M) == ["Context", "Decision", "Consequence"]


@pytest.mark.parametrize("page", DECISIONS, ids=lambda p: p.stem)
def test_the_page_that_supersedes_another_says_so(page: Path) -> None:
    other = STATUS.match(page.read_text("utf-8").split("\n\n")[1])
    assert other is not None
    if other[2]:
        assert re.search(rf"^Supersedes: .*\({page.name}\)", (FOLDER / other[2]).read_text(), re.M)


def test_the_overview_lists_every_decision_once() -> None:
    listed = re.findall(r"^- \[.+?\]\((.+?)\): ", INDEX.read_text("utf-8"), re.M)
    assert sorted(listed) == [page.name for page in DECISIONS]


@pytest.mark.parametrize("page", NAMING_FILES, ids=lambda p: p.stem)
def test_files_named_on_a_page_exist(page: Path) -> None:
    for name in NAMED_FILE.findall(page.read_text("utf-8")):
        assert (ROOT / name).is_file(), f"{page.name}: {name}"
