"""A lane of whatever kind has the very bits of the plain program, whatever its neighbours do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from c_plant import (
    CPlant,
    Numbers,
    changed,
    kerb,
    lib,
    obstacles,
    plane,
    random_fields,
    robot_of,
    same_bits,
    trot,
    waves,
)
from c_plant_checks import LATE, grounds, kinds, side_by_side

from apnc_plant.numbers import robot_numbers
from apnc_plant.robot import load_robot

NAMES = {lib().PLANT_LEGS: "legs", lib().PLANT_ROBOTS: "robots"}


@pytest.fixture(params=kinds(lib()), ids=lambda kind: f"{NAMES[kind[0]]}-{kind[1]}")
def kind(request: pytest.FixtureRequest) -> tuple[int, int]:
    """Kind and level."""
    found: tuple[int, int] = request.param
    return found


@pytest.mark.parametrize("legs", [2, 3, 4, 5, 6, 7, 8, 9, 31, 64])
def test_robots_that_differ_on_grounds_that_differ(kind: tuple[int, int], legs: int) -> None:
    for lane in side_by_side(lib(), *kind, legs, list(grounds().values()), ticks=40):
        assert lane.same
        assert len(lane.alone) > 30


@pytest.mark.parametrize("legs", [2, 4, 5, 7, 64])
def test_robots_on_planes_alone(kind: tuple[int, int], legs: int) -> None:
    for lane in side_by_side(lib(), *kind, legs, [plane(), plane(0.1)], ticks=40):
        assert lane.same


def shipped(name: str, lane: int) -> Numbers:
    """A shipped robot with a payload and an error of its own."""
    robot = load_robot(name)
    late = replace(
        robot,
        servo=replace(robot.servo, latency=LATE["servo"]["latency"]),
        sensor=replace(robot.sensor, delay=LATE["sensor"]["delay"]),
    )
    return robot_numbers(late, side_offset=0.001 * lane, payload=0.1 * lane)


@pytest.mark.parametrize(
    "name",
    [
        "lilibot",
        *(pytest.param(name, marks=pytest.mark.thorough) for name in ("hexapod", "octopod")),
    ],
)
@pytest.mark.parametrize(
    "ground",
    [plane(), plane(0.08), obstacles(2, 0.004), kerb(0.09, 0.004), waves()],
    ids=["plane", "slope", "obstacles", "kerb", "waves"],
)
def test_shipped_robots_over_three_seconds(
    kind: tuple[int, int], name: str, ground: Numbers
) -> None:
    def robot(lane: int, legs: int) -> Numbers:
        return shipped(name, lane)

    legs = len(load_robot(name).legs)
    for lane in side_by_side(lib(), *kind, legs, [ground], ticks=180, robot=robot):
        assert lane.same
        assert lane.alone[:, 9 + 18 * legs :].max() > 3.0  # the feet carry something


def test_a_robot_that_breaks_down_or_falls_leaves_its_neighbours_alone(
    kind: tuple[int, int],
) -> None:
    def robot(lane: int, legs: int) -> Numbers:
        if lane % 4 == 1:  # feet so stiff that no step can follow
            fields = random_fields(np.random.default_rng(lane), legs)
            return robot_of(changed(fields, contact={"stiffness": 1e300}, **LATE))
        if lane % 4 == 2:  # legs so weak that it lies down
            fields = random_fields(np.random.default_rng(lane), legs)
            weak = LATE["servo"] | {"stall_torque": 0.01}
            return robot_of(changed(fields, servo=weak, sensor=LATE["sensor"]))
        return shipped("lilibot", lane)

    found = side_by_side(lib(), *kind, 4, [plane(), waves()], ticks=90, robot=robot)
    ends = [lane.states[0] for lane in found]
    if len(found) > 1:
        assert ends[:4] == [
            lib().PLANT_WALKS, lib().PLANT_DIVERGED, lib().PLANT_FELL, lib().PLANT_WALKS,
        ]  # fmt: skip
    for lane in found:
        assert lane.same


def test_the_sign_of_a_zero_that_all_legs_share_is_kept(kind: tuple[int, int]) -> None:
    def robot(lane: int, legs: int) -> Numbers:
        fields = random_fields(np.random.default_rng(lane), legs)
        limp = LATE["servo"] | {"stall_torque": -0.0}
        return robot_of(changed(fields, servo=limp, sensor=LATE["sensor"]))

    for lane in side_by_side(lib(), *kind, 5, [plane()], ticks=5, robot=robot):
        assert lane.same


def test_levels_may_change_on_the_way() -> None:
    legs, kind = 5, lib().PLANT_LEGS
    plants = [CPlant(legs, kind=which) for which in (lib().PLANT_SCALAR, kind)]
    for plant in plants:
        plant.place(robot_of(random_fields(np.random.default_rng(1), legs)), plane())
    for tick in range(30):
        lib().plant_use_level(plants[1].memory, tick % (lib().plant_best_level() + 1))
        assert same_bits(*(plant.tick(*trot(legs, tick)) for plant in plants))


def test_a_level_that_lays_out_a_plant_otherwise_is_not_taken() -> None:
    legs, kind = 3, lib().PLANT_ROBOTS
    widths = [lib().plant_lanes(kind, level) for level in range(lib().plant_best_level() + 1)]
    plant = CPlant(legs, kind=kind, level=0)
    before = plant.bytes()
    for level, width in enumerate(widths):
        lib().plant_use_level(plant.memory, level)
        assert (plant.bytes() == before) == (level == 0 or width != widths[0])
        lib().plant_use_level(plant.memory, 0)
