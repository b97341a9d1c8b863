"""The runs by which a candidate is judged: what more than four legs are asked for besides."""

from __future__ import annotations

import numpy as np
import pytest

from apnc.tune.design import MI_AIMED, Candidate, Start, candidate, variables_for
from apnc.tune.runs import (
    AIR_COUNT,
    LEG_OFF,
    MI_COUNT,
    Task,
    of_check,
    of_generation,
    of_validation,
)
from apnc_plant.robot import RobotDescription, load_robot


def begun(robot: str) -> tuple[Start, Candidate]:
    description = load_robot(robot)
    start = Start(description, 60.0, MI_AIMED, variables_for(description))
    return start, candidate(start, start.first())


def let_down(tasks: list[Task]) -> list[float]:
    return [task.share for task in tasks if task.kind == "air"]


@pytest.mark.parametrize(("robot", "count"), [("lilibot", 1), ("hexapod", AIR_COUNT)])
def test_many_legs_are_let_down_from_the_air_over_the_whole_range(robot: str, count: int) -> None:
    start, found = begun(robot)
    shares = let_down(of_generation(start, [found], 3)[0])
    cells = [int(count * share) for share in shares]
    assert cells == list(range(count))
    assert len(let_down(of_check(start, found))) == (11 if count > 1 else 0)
    assert len(let_down(list(of_validation(start, found, 2)))) == 2 * (MI_COUNT if count > 1 else 1)


def heights(robot: RobotDescription) -> np.ndarray:
    return np.array([leg.mount[2] for leg in robot.legs])


@pytest.mark.parametrize(("robot", "most"), [("lilibot", 0.0), ("octopod", 0.155 * LEG_OFF)])
def test_each_of_many_legs_has_a_height_of_its_own_on_a_body_that_is_off(
    robot: str, most: float
) -> None:
    start, found = begun(robot)
    (tasks,) = of_generation(start, [found], 3)
    off = np.array([
        heights(task.experiment.description) - heights(found.robot) for task in tasks
    ])  # fmt: skip
    assert np.abs(off).max() == pytest.approx(most, rel=0.2)
    assert np.abs(off).max() <= most
    distinct = {round(float(value), 9) for value in off[0]}
    assert len(distinct) == (len(found.robot.legs) if most else 1)
    others = [task for task in of_validation(start, found, 1) if task.kind == "walk"]
    assert not np.abs(heights(others[0].experiment.description) - heights(found.robot)).any()
