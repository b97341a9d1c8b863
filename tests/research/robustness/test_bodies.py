"""Bodies by chance: what is varied, and how it is counted."""

from __future__ import annotations

from typing import Any

import pytest
from made_up_results import made_up

from apnc.studies.results import STRICT
from apnc.studies.runner import grid_of
from apnc_plant.robot import load_robot
from research import robustness
from research.registry import STUDIES
from research.robustness.walks import WALKS

LILIBOT = load_robot("lilibot")


def test_a_seed_is_the_same_body_with_errors_of_another_size() -> None:
    small, large = (robustness.body("lilibot", share, 3).servo for share in (0.1, 0.3))
    off = small.stiffness - LILIBOT.servo.stiffness
    assert off != 0.0
    assert large.stiffness - LILIBOT.servo.stiffness == pytest.approx(3.0 * off)
    assert robustness.body("lilibot", 0.1, 4).servo.stiffness != small.stiffness
    assert robustness.body("lilibot", 0.0, 3) == LILIBOT


def test_the_controller_is_not_told_what_the_body_weighs() -> None:
    chosen = {"share": [0.3], "walk": ["MI 0.15", "20 Hz"]}
    trials = grid_of("robustness", 1, chosen=chosen, studies=STUDIES, robot="lilibot")
    for trial in trials:
        assert trial.experiment.parameters()["robot_weight"] == LILIBOT.weight
        assert trial.experiment.description.weight != LILIBOT.weight
    assert {(t.experiment.mi, t.experiment.rate) for t in trials} == {(0.15, 60.0), (0.08, 20.0)}


def test_a_body_counts_for_all_walks_if_it_forms_the_gait_in_each() -> None:
    def figures(cell: dict[str, Any]) -> dict[str, Any]:
        lost = cell["seed"] == 0 and cell["walk"] == "20 Hz"
        fell = cell["seed"] == 1 and cell["walk"] == "MI 0.08"
        return {STRICT: None if lost else 2.0, "fell": fell}

    axes = {"share": (0.1,), "walk": tuple(WALKS)}
    results = made_up(axes, figures, controllers=("apnc",), seeds=5, study="robustness")
    results = [r for r in results if (r["seed"], r["walk"]) != (4, "MI 0.15")]  # not run yet
    rows = {row["walk"]: (row["strict"], row["bodies"]) for row in robustness.counts(results)}
    assert rows["20 Hz"] == (4, 5) and rows["MI 0.08"] == (4, 5) and rows["MI 0.15"] == (4, 4)
    assert rows[robustness.EVERY] == (2, 4)


def test_the_table_and_the_picture_show_the_same_shares() -> None:
    axes = {"share": (0.0, 0.1), "walk": ("MI 0.08",)}
    results = made_up(
        axes,
        lambda cell: {STRICT: 1.0 if cell["share"] == 0.0 or cell["seed"] else None},
        controllers=("apnc", "apc"),
        seeds=4,
        study="robustness",
    )
    rows = robustness.counts(results)
    lines = robustness.counts_table(rows).splitlines()
    assert lines[0] == "| off by at most | controller | MI 0.08 | all walks |"
    assert lines[4].startswith("| 10 % | APNC | 3/4 (19 ... 99 %) |")
    apnc, _ = robustness.shares_formed(rows)
    assert (apnc["x"], apnc["y"]) == ([0.0, 10.0], [100.0, 75.0])
    assert apnc["error_y"]["arrayminus"][1] == pytest.approx(75.0 - 19.4, abs=0.1)
