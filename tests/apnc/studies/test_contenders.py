"""The contenders: the paper's settings per study, and the best ones against the rows."""

from __future__ import annotations

import csv
import gzip
from pathlib import Path

import pytest

from apnc.studies import gains
from apnc.studies.contenders import CONTENDERS, RIVALS, contender
from apnc.studies.rows import AUTHORS, Row, cells_in, matching
from apnc_core.enumerations import Method

ROWS = Path(__file__).parents[3] / "docs" / "data" / "evaluation.csv.gz"


@pytest.mark.parametrize(
    ("study", "gain"),
    [
        # half of the authors' code, since our loads are over half the weight, theirs over all of it
        ("mi", 0.015), ("rate", 0.015), ("terrain", 0.015),
        ("conditions", 0.15), ("damage", 0.15), ("states", 0.15),
    ],
)  # fmt: skip
def test_tegotae_has_the_gain_of_the_authors_code_for_each_study(study: str, gain: float) -> None:
    assert contender("tegotae").settings_in(study) == {"gamma_tegotae": gain}


def test_the_other_settings_are_the_same_in_every_study() -> None:
    assert contender("phase_reset").settings_in("mi") == {"grf_reset": 0.4}
    assert contender("apnc_printed").settings_in("gains") == {"B_f": 0.002, "B_s": 0.0002}
    for label in ("apnc", "apc"):
        assert not contender(label).settings_in("mi") and not contender(label).in_study
    for label in ("tegotae_best", "phase_reset_best"):
        assert contender(label).settings and not contender(label).in_study


def test_labels_stand_for_methods_of_the_fmu() -> None:
    assert {each.method for each in CONTENDERS.values()} <= set(Method.__members__)
    for label in RIVALS:
        assert label.removesuffix("_best") == contender(label).method


def test_no_setting_of_a_baseline_walks_more_often_than_its_best() -> None:
    rows = _rows_of_gains()
    if not rows:
        pytest.skip("docs/data/evaluation.csv.gz has no rows of the study 'gains'")
    for label, name in gains.PARAMETERS.items():
        own = matching(rows, method=label)
        # with as many walks it is a matter of five seeds which of two gains is the quicker
        count = {
            gain: (gains.walks(part), gains.walks(part, AUTHORS))
            for gain in cells_in(own, "gain")
            for part in [matching(own, gain=gain)]
        }
        assert count[contender(f"{label}_best").settings[name]] == max(count.values())


def _rows_of_gains() -> list[Row]:
    if not ROWS.is_file():
        return []
    with gzip.open(ROWS, "rt", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["study"] == "gains"]
    numbers = ("gain", "convergence_time_s", "convergence_time_authors_s", gains.LATE_SPEED)
    return [
        row
        | {name: float(row[name]) if row[name] else None for name in numbers}
        | {"fell": row["fell"] == "True"}
        for row in rows
    ]
