"""Tables of studies in the pages of the documentation."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("put_table", ROOT / "docs/put_table.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


PAGE = "before\n\n<!-- gait -->\n| old |\n|---|\n| 1 |\n\n<!-- mi -->\n| other |\n\nafter\n"


def test_only_the_table_below_the_mark_is_changed(script: ModuleType) -> None:
    found = script.put(PAGE, "gait", "# title\n\n| new |\n|---|\n| 2 |\n| 3 |\n\n| second |\n")
    assert found == PAGE.replace("| old |\n|---|\n| 1 |\n", "| new |\n|---|\n| 2 |\n| 3 |\n")


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [("gait", "no table\n", "gait: no table"), ("rate", "| a |\n", "'<!-- rate -->'.*0 times")],
)
def test_a_missing_table_or_mark_is_said(
    script: ModuleType, name: str, text: str, said: str
) -> None:
    with pytest.raises(ValueError, match=said):
        script.put(PAGE, name, text)
