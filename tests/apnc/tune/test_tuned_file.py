"""The file of a tuned robot: that of the robot, with the numbers that were found."""

from __future__ import annotations

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from apnc.tune.design import MI_AIMED, Start, candidate, variables_for
from apnc.tune.tuned_file import Change, changes, path_of, read_back, tuned_text
from apnc_core.interface import Parameters
from apnc_plant.robot import ROBOTS, RobotDescription, load_robot

SHIPPED = sorted(path.stem for path in ROBOTS.glob("*.toml"))


def found(robot: RobotDescription) -> RobotDescription:
    """A robot that differs in everything that a search may change."""
    variables = variables_for(robot, servo=True, body=True)
    x = np.random.default_rng(3).uniform(0.2, 0.8, len(variables))
    return candidate(Start(robot, 60.0, MI_AIMED, variables), x).robot


@pytest.mark.parametrize("name", SHIPPED)
def test_the_file_reads_back_as_the_robot_to_five_digits(name: str) -> None:
    wanted = replace(found(load_robot(name)), mi=0.13)
    back = read_back(tuned_text(name, wanted, ["a comment"]))
    for place, old, new in changes(wanted, back):
        assert np.allclose(np.asarray(old, float), np.asarray(new, float), rtol=1e-4), place
    assert back != load_robot(name)
    assert {place[0] for place, _, _ in changes(load_robot(name), back)} >= {
        "trunk", "legs", "servo", "contact", "controller", "rate", "mi_range", "mi",
    }  # fmt: skip


@pytest.mark.parametrize("name", SHIPPED)
def test_the_file_of_the_robot_itself_says_the_same(name: str) -> None:
    robot = load_robot(name)
    text = tuned_text(name, robot, [])
    assert text == "\n" + path_of(name).read_text(encoding="utf-8")


def test_comments_order_and_everything_else_stay(tmp_path: Path) -> None:
    top, trunk = path_of("lilibot").read_text(encoding="utf-8").split("[trunk]")
    trunk, sensor = trunk.split("[sensor]")
    own = "[controller]  # mine\na2 = 0.3 # of my own\n# between\na1=0.15\n\n"
    source = tmp_path / "mine.toml"
    source.write_text(f"{top}{own}[sensor]{sensor}\n[trunk]{trunk}# the end\n", encoding="utf-8")
    robot = load_robot(source)
    assert robot.mi is not None
    new = replace(robot, controller={**robot.controller, "a1": 0.2, "B_f": 0.1}, mi=0.11)
    text = tuned_text(source, new, ["Tuned."])
    assert text.startswith("# Tuned.\n\n")
    before, after = source.read_text(encoding="utf-8").splitlines(), text.splitlines()[2:]
    assert [line for line in after if line not in before] == ["mi = 0.11", "a1=0.2", "B_f = 0.1"]
    assert [line for line in after if line in before] == [
        line for line in before if line not in ("a1=0.15", f"mi = {robot.mi}")
    ]
    assert tomllib.loads(text)["controller"] == {"a2": 0.3, "a1": 0.2, "B_f": 0.1}


def test_changes_are_given_as_the_file_has_them() -> None:
    robot = load_robot("lilibot")
    leg = replace(robot.legs[1], femur_angle=math.radians(40.0))
    other = replace(
        robot,
        legs=(robot.legs[0], leg, *robot.legs[2:]),
        controller={**robot.controller, "B_s": 0.00123456789},
        mi=0.1,
    )
    assert set(changes(robot, other)) == {
        Change(("legs", "RH", "femur_angle"), 71.0, 40.0),
        Change(("controller", "B_s"), Parameters().B_s, 0.0012346),
        Change(("mi",), 0.25, 0.1),
    }
