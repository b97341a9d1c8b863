"""The navigation of the site has every page, and the reference every public name."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

import apnc

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
SITE: dict[str, Any] = yaml.safe_load((ROOT / "mkdocs.yml").read_text("utf-8"))
MADE = {"tutorial/tutorial.md"}
"""Pages that ``.ci/docs`` makes."""


def pages_in(nav: Any) -> list[str]:
    """Pages below a part of the navigation, in its order."""
    if isinstance(nav, str):
        return [nav]
    parts = nav.values() if isinstance(nav, dict) else nav
    return [page for part in parts for page in pages_in(part)]


def test_navigation_lists_every_page_once() -> None:
    pages = {page.relative_to(DOCS).as_posix() for page in DOCS.rglob("*.md")}
    assert sorted(pages_in(SITE["nav"])) == sorted(pages - {SITE["exclude_docs"]} | MADE)


def test_reference_has_every_public_name() -> None:
    page = (DOCS / "api" / "apnc.md").read_text("utf-8")
    names = re.findall(r"^::: apnc\.(\w+)$", page, re.M)
    assert sorted(names) == sorted(set(apnc.__all__) - {"__version__"})


def test_the_site_loads_nothing_from_elsewhere() -> None:
    assert SITE["theme"]["font"] is False
    own = [*SITE["extra_css"], *SITE["extra_javascript"]]
    assert all((DOCS / name).is_file() for name in own)


def test_links_to_the_page_to_play_with_lead_to_it() -> None:
    """In HTML, too, a link is written from the page in ``docs``: the site's address is another."""
    for page in (DOCS / "index.md", DOCS / "play.md"):
        (target,) = re.findall(r'href="([^"]*page\.html)"', page.read_text("utf-8"))
        assert page.parent / target == DOCS / "play" / "page.html"
