"""What a tuned robot does, in words."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from made_up_tuned import MI, WALK, tuned, validation

from apnc.tune import Cell, Validation
from apnc.tune.validation import with_article
from apnc.tune.wording import COLUMNS, changed, lines_to_paste, others, table, verdicts


def test_all_reached() -> None:
    found, margin, missed = verdicts(tuned(validation()))
    assert (found.answer, found.mood) == ("Trot at 5 of 5 MI", "good")
    assert "20 of 20 walks with ANC" in found.detail
    assert "0.123 to 0.173 m/s" in found.detail
    assert (margin.answer, margin.mood) == ("20 of 20", "good")
    assert (missed.answer, missed.mood) == ("Nothing", "good")
    assert validation().missed() == []


def test_a_single_fall_is_no_trot_at_this_mi() -> None:
    made = validation({("walk", 0): 1, ("varied", 1): 3, ("apc", 4): 2})
    found, margin, missed = verdicts(tuned(made))
    assert (found.answer, found.mood) == ("Trot at 4 of 5 MI", "fair")
    assert (margin.answer, margin.mood) == ("17 of 20", "fair")
    assert missed.answer == "3 of 9 aims"
    assert missed.detail.startswith("with ANC at 1 MI, with APC alone at 1 MI, on bodies off by")
    words = [each.words for each in made.missed()]
    assert words[0] == "with ANC, aimed at 4 of 4 in a trot that holds: 3 at MI 0.08"


def test_a_robot_that_never_walks_is_called_so() -> None:
    made = validation({(kind, k): 4 for kind in ("walk", "apc", "varied") for k in range(5)})
    found, margin, missed = verdicts(tuned(made))
    assert (found.answer, found.mood) == ("No trot that walks", "bad")
    assert (margin.answer, margin.mood) == ("0 of 20", "bad")
    assert "m/s" not in found.detail
    assert table(made)[0] == (
        "0.08",
        "0",
        "0",
        "0",
        *("\N{EN DASH}" if x == "-" else x for x in ("-", "fell", "-", "-")),
    )
    assert [each.aim for each in made.missed()][3:] == [
        "lift of the lowest foot", "slip of a foot", "speed",
    ]  # fmt: skip
    assert (missed.answer, missed.mood) == ("6 of 9 aims", "fair")


def test_an_interrupted_search_speaks_of_its_own_check() -> None:
    (found,) = verdicts(tuned(None))
    assert found.answer == "Trot at 11 of 11 MI"
    assert "Interrupted" in found.detail


@pytest.mark.parametrize(
    ("measure", "value", "aim", "words"),
    [
        (
            "lift",
            0.049,
            "lift of the lowest foot",
            "aimed at 7.8 mm (5 % of the leg): 7.6 mm at MI 0.1",
        ),
        ("slip", 0.19, "slip of a foot", "aimed at at most 18 % of the stride: 19 % at MI 0.1"),
    ],
)
def test_feet_below_an_aim_are_told_in_its_units(
    measure: str, value: float, aim: str, words: str
) -> None:
    runs = (replace(WALK, **{measure: value}),) * 3
    made = Validation((Cell("walk", 0.1, runs),), 0.155, 1.233, 1.0, "trot")
    (missed,) = made.missed()
    assert missed.aim == aim
    assert words in missed.words


def test_the_table_has_a_row_for_each_mi() -> None:
    made = validation({("walk", 2): 1})
    rows = table(made)
    assert [row[0] for row in rows] == [f"{mi:.3g}" for mi in MI]
    assert all(len(row) == len(COLUMNS) for row in rows)
    assert rows[2][1:4] == ("3", "4", "4")
    assert rows[0][4:] == ("2.0", "0.123", "10.8", "10")
    assert others(made)[1] == "one foot sensor dead, MI 0.15: 4 of 4"


def test_what_changed_has_units_and_no_row_for_what_stayed() -> None:
    rows = {row[0]: row[1:] for row in changed(tuned(None))}
    assert rows == {
        "controller.a1": ("0.14", "0.2", "rad"),
        "mi": ("0.25", "0.13", "1"),
        "mi_range": ("0.04, 0.4", "0.08, 0.28", "1"),
        "rate": ("\N{EN DASH}", "60", "Hz"),
    }


def test_lines_to_paste_quote_the_file() -> None:
    for _, line in lines_to_paste(Path("my robot.toml")):
        assert "'my robot.toml'" in line


def test_a_gait_has_its_article() -> None:
    assert with_article("trot") == "a trot"
    assert with_article("alternating tetrapod") == "an alternating tetrapod"
