"""docs/record.md describes every column of record.csv."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import pytest
from records import synthetic_record

from apnc.loop.record import column_names

DOCS = Path(__file__).resolve().parents[3] / "docs"


@pytest.fixture(scope="module")
def maker() -> dict[str, Any]:
    return runpy.run_path(str(DOCS / "make_record.py"))


def test_page_is_up_to_date(maker: dict[str, Any]) -> None:
    page: str = maker["page"]()
    assert (DOCS / "record.md").read_text(encoding="utf-8") == page


def test_every_column_of_a_run_has_its_row_with_unit_and_meaning(maker: dict[str, Any]) -> None:
    rows = {}
    for line in maker["page"]().splitlines():
        if line.startswith("| `"):
            name, *cells = (cell.strip() for cell in line.strip("| ").split(" | "))
            rows[name.strip("`")] = cells
    columns = column_names(synthetic_record(0.1))
    assert len({c.name for c in columns}) == len(columns)
    for column in columns:
        leg, _, rest = column.name.partition(".")
        name = f"LEG.{rest}" if leg in ("RF", "RH", "LF", "LH") else column.name
        name = f"{name[:-1]}k" if name.startswith("phi") else name
        unit, frame, meaning, sign = rows[name]
        assert unit == (column.unit or "–")
        assert frame == (column.frame or "–")
        assert meaning.replace("&#124;", "|") == column.description
        assert sign == (column.sign or "–")
