"""What is searched: the page has every variable, and the start is the robot of the file."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from apnc.tune.design import MI_AIMED, Start, candidate, variables_for
from apnc_core.interface import Parameters
from apnc_plant.robot import load_robot

PAGE = Path(__file__).parents[3] / "docs" / "robots" / "tune.md"
EVERY = variables_for(load_robot("hexapod"), servo=True, body=True)


def test_the_page_has_every_variable_with_its_range() -> None:
    if not PAGE.exists():
        pytest.skip("no documentation beside the tests")
    row = re.compile(r"^\| `([\w.]+)` \| (\S+) to (\S+) \| (\w+) \|", re.MULTILINE)
    rows = row.findall(PAGE.read_text(encoding="utf-8"))
    told = {name: (float(low), float(high), scale == "log") for name, low, high, scale in rows}
    assert told == {each.name: tuple(each[1:]) for each in EVERY}


def test_the_first_candidate_is_the_robot_of_the_file() -> None:
    robot = replace(load_robot("lilibot"), mi=None, mi_range=None)
    start = Start(robot, 60.0, MI_AIMED, EVERY)
    found = candidate(start, start.first()).robot
    assert found.legs == robot.legs
    assert found.mi_range == pytest.approx(MI_AIMED)
    assert found.servo.stiffness == pytest.approx(robot.servo.stiffness)
    assert found.servo.damping == pytest.approx(robot.servo.damping)
    assert found.trunk.com == pytest.approx(robot.trunk.com)
    assert found.mass == pytest.approx(robot.mass)


def test_the_search_begins_at_the_middle_of_the_range_in_the_file() -> None:
    robot = load_robot("lilibot")
    assert robot.mi_range is not None
    start = Start(robot, 60.0, MI_AIMED, EVERY)
    low, high = candidate(start, start.first()).robot.mi_range or (0.0, 0.0)
    assert low * high == pytest.approx(math.prod(robot.mi_range))
    assert high / low == pytest.approx(MI_AIMED[1] / MI_AIMED[0])


@pytest.mark.parametrize("variable", EVERY, ids=lambda each: each.name)
def test_a_place_is_that_of_its_value_and_changes_the_robot(variable: object) -> None:
    robot = load_robot("lilibot")
    start = Start(robot, 60.0, MI_AIMED, EVERY)
    index = EVERY.index(variable)  # type: ignore[arg-type]
    assert [EVERY[index].place(EVERY[index].value(x)) for x in (0.0, 0.3, 1.0)] == pytest.approx(
        [0.0, 0.3, 1.0]
    )
    x = np.array(start.first())
    before = candidate(start, x).robot
    x[index] = 0.9 if x[index] < 0.5 else 0.1
    after = candidate(start, x).robot
    assert after != before
    assert after.mass == pytest.approx(before.mass)


def test_what_is_kept_is_as_in_the_file() -> None:
    robot, kept = load_robot("lilibot"), ("a1", "b1", "b2")
    variables = variables_for(robot, kept=kept)
    start = Start(robot, 60.0, MI_AIMED, variables, reference=True)
    found = candidate(start, np.full(len(variables), 0.7)).robot
    for name in kept:
        assert found.controller.get(name, getattr(Parameters(), name)) == getattr(
            Parameters(), name
        )
    assert found.controller["a2"] != Parameters().a2
    assert found.legs[0].femur_angle != robot.legs[0].femur_angle
