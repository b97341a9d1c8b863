"""What pyproject.toml names is there, and the page on installing says the same."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
EXTRAS: dict[str, list[str]] = PYPROJECT["project"]["optional-dependencies"]


def extras_in(name: str) -> set[str]:
    """Extras that an extra brings with it."""
    found = {
        extra.strip()
        for requirement in EXTRAS[name]
        for group in re.findall(r"^apnc\[(.*)\]", requirement)
        for extra in group.split(",")
    }
    return found.union(*(extras_in(extra) for extra in found))


def test_the_extra_all_has_every_ability() -> None:
    assert extras_in("all") == set(EXTRAS) - {"all", "test"}


def test_the_page_on_installing_lists_every_extra() -> None:
    page = (ROOT / "docs" / "install.md").read_text()
    _, table = page.split("| extra |")
    rows = table.split("\n\n")[0].splitlines()[2:]
    assert {row.split("`")[1] for row in rows} == set(EXTRAS)


@pytest.mark.parametrize(
    "key", ["source_paths", "only_mutate", "also_copy", "pytest_add_cli_args_test_selection"]
)
def test_paths_of_the_mutation_test_exist(key: str) -> None:
    for pattern in PYPROJECT["tool"]["mutmut"][key]:
        assert list(ROOT.glob(pattern)), pattern
