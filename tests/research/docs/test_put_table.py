"""Tables of studies in the pages of the documentation."""

from __future__ import annotations

import pytest

from research.docs.put_table import put

PAGE = "before\n\n<!-- gait -->\n| old |\n|---|\n| 1 |\n\n<!-- mi -->\n| other |\n\nafter\n"


def test_only_the_table_below_the_mark_is_changed() -> None:
    found = put(PAGE, "gait", "# title\n\n| new |\n|---|\n| 2 |\n| 3 |\n\n| second |\n")
    assert found == PAGE.replace("| old |\n|---|\n| 1 |\n", "| new |\n|---|\n| 2 |\n| 3 |\n")


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [("gait", "no table\n", "gait: no table"), ("rate", "| a |\n", "'<!-- rate -->'.*0 times")],
)
def test_a_missing_table_or_mark_is_said(name: str, text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        put(PAGE, name, text)
