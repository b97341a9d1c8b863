"""Varied robots are off in every uncertain number, by no more than they may be."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest

from apnc.varied import varied
from apnc_plant.robot import Body, RobotDescription, load_robot

SHARE = 0.1


@pytest.fixture(scope="module")
def robots() -> tuple[RobotDescription, list[RobotDescription]]:
    robot, rng = load_robot("lilibot"), np.random.default_rng(1)
    return robot, [varied(robot, SHARE, rng) for _ in range(200)]


def bodies(robot: RobotDescription) -> list[Body]:
    leg = robot.legs[0]
    return [robot.trunk, leg.hip, leg.femur, leg.tibia]


def test_every_number_of_servo_contact_sensor_and_every_mass_is_off_by_itself(
    robots: tuple[RobotDescription, list[RobotDescription]],
) -> None:
    robot, copies = robots
    shares = {}
    for part in ("servo", "contact", "sensor"):
        for field in fields(getattr(robot, part)):
            value = getattr(getattr(robot, part), field.name)
            if not isinstance(value, float) or field.name == "foot_radius" or value == 0.0:
                continue  # a word, a length, what joints have of their own, what is not there
            own = [getattr(getattr(copy, part), field.name) / value for copy in copies]
            shares[f"{part}.{field.name}"] = own
    for index, body in enumerate(bodies(robot)):
        shares[f"mass {index}"] = [bodies(copy)[index].mass / body.mass for copy in copies]
    for name, own in shares.items():
        assert 1.0 - SHARE <= min(own) < 0.92 and 1.08 < max(own) <= 1.0 + SHARE, name
    correlation = np.corrcoef(list(shares.values())) - np.eye(len(shares))
    assert np.abs(correlation).max() < 0.35  # five deviations of the chance of 200 robots


def test_a_centre_of_mass_is_shifted_by_a_share_of_its_body(
    robots: tuple[RobotDescription, list[RobotDescription]],
) -> None:
    robot, copies = robots
    for index, body in enumerate(bodies(robot)):
        moved = np.array([bodies(copy)[index].com for copy in copies]) - body.com
        largest = np.abs(moved).max(axis=0) / (SHARE * np.array(body.size) / 2.0)
        sideways = 0.0 if index == 0 else 1.0  # seeds move the trunk's
        assert largest == pytest.approx([1.0, sideways, 1.0], abs=0.1)
        assert (largest <= 1.0).all()


def test_drawings_gains_and_the_likeness_of_legs_stay(
    robots: tuple[RobotDescription, list[RobotDescription]],
) -> None:
    robot, copies = robots
    for copy in copies[:5]:
        assert copy.controller == robot.controller and copy.name == robot.name
        assert copy.trunk.size == robot.trunk.size
        for own, leg in zip(copy.legs, robot.legs, strict=True):
            assert (own.mount, own.femur_length, own.tibia_angle) == (
                leg.mount, leg.femur_length, leg.tibia_angle,
            )  # fmt: skip
            assert own.tibia == copy.legs[0].tibia  # lilibot's legs are alike


def test_the_same_chance_gives_the_same_robot() -> None:
    robot = load_robot("hexapod")
    one, two = (varied(robot, 0.2, np.random.default_rng(7)) for _ in range(2))
    assert one == two != robot
    assert varied(robot, 0.0, np.random.default_rng(7)) == robot
    with pytest.raises(ValueError, match=r"share is 1\.0; allowed: 0 and more, below 1"):
        varied(robot, 1.0, np.random.default_rng(7))


def test_an_inertia_of_its_own_is_off_as_the_mass_is() -> None:
    robot = load_robot("lilibot")
    moments = (0.004, 0.009, 0.011, 0.0002, 0.0001, 0.0003)
    own = replace(robot, trunk=replace(robot.trunk, inertia=moments))
    copy = varied(own, 0.2, np.random.default_rng(3))
    share = copy.trunk.mass / own.trunk.mass
    assert abs(share - 1.0) > 0.01
    assert copy.trunk.inertia == pytest.approx([share * each for each in moments], rel=1e-12)
