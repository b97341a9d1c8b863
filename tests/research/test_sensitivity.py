"""Numbers of the robot: what is changed, and the table."""

from __future__ import annotations

import importlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import pytest
from made_up_results import Result, made_up

from apnc.studies.results import STRICT
from apnc.studies.runner import grid_of
from apnc_plant.robot import load_robot
from research import sensitivity
from research.registry import STUDIES

LILIBOT = load_robot("lilibot")


def test_most_changes_walk_at_three_mi() -> None:
    trials = grid_of("sensitivity", 2, studies=STUDIES)
    cells = Counter((trial.cell["change"], trial.cell["mi"]) for trial in trials)
    assert set(cells.values()) == {2}
    found = Counter(change for change, _ in cells)
    assert found.pop("nothing") == found.pop(sensitivity.SOFT) == 6
    assert len(found) == 27 and set(found.values()) == {3}


def leaves(value: Any, name: str = "") -> dict[str, Any]:
    """Every number of nested data, by its place."""
    if isinstance(value, dict):
        pairs = list(value.items())
    elif isinstance(value, (list, tuple)):
        pairs = list(enumerate(value))
    else:
        return {name: value}
    return {k: v for key, part in pairs for k, v in leaves(part, f"{name}/{key}").items()}


@pytest.fixture
def changes() -> Mapping[str, sensitivity.Change]:
    # made anew: a mutation run switches a mutant on after modules were imported
    found: Mapping[str, sensitivity.Change] = importlib.reload(sensitivity).CHANGES
    return found


@pytest.mark.parametrize("name", sensitivity.CHANGES)
def test_a_change_touches_one_number_of_each_part(
    name: str, changes: Mapping[str, sensitivity.Change]
) -> None:
    robot = changes[name](LILIBOT)
    before, after = leaves(asdict(LILIBOT)), leaves(asdict(robot))
    changed = [key for key in before if before[key] != after[key]]
    if name == "nothing":
        assert changed == []
    elif "tibia" in name:
        assert len(changed) == 2 * len(LILIBOT.legs)
        assert robot.mass == pytest.approx(LILIBOT.mass)
        assert robot.legs[0].femur.mass > LILIBOT.legs[0].femur.mass
    elif name == sensitivity.SOFT:
        assert (robot.servo.stiffness, robot.servo.damping) == (12.0, 1.5)
        assert len(changed) == 2
    else:
        assert len(changed) == 1


def test_changes_do_what_they_say(changes: Mapping[str, sensitivity.Change]) -> None:
    after = {name: change(LILIBOT) for name, change in changes.items()}
    assert after["friction 0.5"].contact.friction == 0.5
    assert after["P x 0.8"].servo.stiffness == pytest.approx(0.8 * LILIBOT.servo.stiffness)
    assert after["sensor shows the norm"].sensor.component == "norm"
    x, y, z = LILIBOT.trunk.com
    higher = after["trunk's centre of mass 10 mm higher"].trunk.com
    assert higher == pytest.approx((x, y, z + 0.01))
    assert after["5 mm further back"].trunk.com == pytest.approx((x - 0.005, y, z))
    legs = after["25 g from each tibia to its femur"].legs
    for leg, own in zip(legs, LILIBOT.legs, strict=True):
        assert leg.femur.mass == pytest.approx(own.femur.mass + 0.025)
        assert leg.tibia.mass == pytest.approx(own.tibia.mass - 0.025)


def test_the_changed_robot_walks() -> None:
    trials = grid_of(
        "sensitivity", 1, chosen={"change": ["friction 0.5"], "mi": [0.1]}, studies=STUDIES
    )
    assert [t.experiment.description.contact.friction for t in trials] == [0.5]
    assert [t.experiment.mi for t in trials] == [0.1]


def test_an_unknown_change_is_refused() -> None:
    with pytest.raises(ValueError, match="change 'moon' is not one of nothing, "):
        grid_of("sensitivity", 1, chosen={"change": ["moon"]}, studies=STUDIES)


def test_the_table_of_sensitivity_shows_what_did_not_form() -> None:
    def figures(cell: Result) -> Result:
        time = None if cell["seed"] else 3.21
        return {STRICT: time, "path_speed_m_per_s": 0.05, "fell": bool(cell["seed"])}

    cells = {"change": ("nothing",), "mi": (0.08, 0.16)}
    results = made_up(cells, figures, controllers=("apnc",), seeds=2, study="sensitivity")
    assert sensitivity.table(results).splitlines()[0] == (
        "| change | MI 0.08: trot after [s] | MI 0.08: speed [m/s] | "
        "MI 0.16: trot after [s] | MI 0.16: speed [m/s] | fell |"
    )
    assert sensitivity.table(results).splitlines()[2] == (
        "| nothing | 3.2, - | 0.050 | 3.2, - | 0.050 | 2/4 |"
    )


def test_the_duty_factor_is_shown_of_what_walked_at_more_mi() -> None:
    def figures(cell: Result) -> Result:
        return {"duty_factor_mean": 0.5 + cell["mi"], "path_speed_m_per_s": 0.05}

    cells = {"change": ("nothing", "P x 0.8", sensitivity.SOFT), "mi": (0.04, 0.08, 0.16, 0.24)}
    every = made_up(cells, figures, controllers=("apnc",), seeds=1, study="sensitivity")
    assert "duty" not in sensitivity.table([r for r in every if r["mi"] < 0.2])
    results = [r for r in every if r["mi"] < 0.2 or r["change"] != "P x 0.8"]
    changes, duty = sensitivity.table(results).split("\n\n")
    assert "MI 0.24" not in changes and len(changes.splitlines()) == 5
    assert duty.splitlines()[2].startswith("| nothing | 0.54 (0.54 ... 0.54) | 0.050 (0.050")
    assert [line.split(" | ")[0] for line in duty.splitlines()[2:]] == [
        "| nothing",
        f"| {sensitivity.SOFT}",
    ]
