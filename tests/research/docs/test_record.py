"""docs/record.md describes every column of record.csv."""

from __future__ import annotations

from records import synthetic_record

from apnc.features import walk_features
from apnc.loop.columns import column_names
from apnc.report.figures import all_figures
from apnc.report.lines import Run
from apnc_plant.signals import JOINT_SIGNS
from research.docs import DOCS
from research.docs.record import page


def test_page_is_up_to_date() -> None:
    assert (DOCS / "record.md").read_text(encoding="utf-8") == page()


def test_every_column_of_a_run_has_its_row_with_unit_and_meaning() -> None:
    rows = {}
    for line in page().splitlines():
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


def test_the_signs_of_the_joints_are_told_in_the_same_words_everywhere() -> None:
    pages = [(DOCS / page).read_text(encoding="utf-8") for page in ("record.md", "robots/own.md")]
    record = synthetic_record(1.0)
    notes = [
        f.note for f in all_figures(Run(record, walk_features(record))) if f.key in JOINT_SIGNS
    ]
    assert len(notes) == 2
    for joint, effect in JOINT_SIGNS.items():
        assert f"{joint}: {effect}" in pages[0]
        assert f"| {joint} | {effect}" in pages[1]
    for note, joint in zip(notes, ("hip", "knee"), strict=True):
        assert f"a positive angle {JOINT_SIGNS[joint]}." in note
