"""The plant in C against the reference in Exudyn, and against itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from full_robot import full_robot
from grounds import WALKED
from made_up_robots import every_chain
from odd_robot import odd_robot
from plants import trot

from apnc_plant.compiled import KINDS, CompiledPlant
from apnc_plant.conditions import Conditions, named_conditions
from apnc_plant.ground import Ground, Obstacles, Plane
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from exudyn_models.plant import ExudynPlant

TICK = 1 / 60
ROBOT = load_robot("lilibot")
LATE = replace(ROBOT, servo=replace(ROBOT.servo, latency=0.023, slew_rate=2.0))
DULL = replace(ROBOT, sensor=replace(ROBOT.sensor, delay=0.04, component="norm"))


PLACES = ("position", "rpy", "joint_angle", "foot_position", "joint_work")
FORCES = ("foot_force", "grf", "joint_torque")
SPEEDS = ("velocity", "joint_speed")


def apart(one: CompiledPlant, other: ExudynPlant, names: tuple[str, ...]) -> float:
    ours, theirs = one.sample(), other.sample()
    return max(float(np.abs(ours[name] - theirs[name]).max()) for name in names)


def assert_same(
    robot: RobotDescription,
    seconds: float = 2.0,
    *,
    ground: Ground | None = None,
    conditions: Conditions | None = None,
    duration: float = TICK,
    options: PlantOptions | None = None,
) -> None:
    """Both plants do the same under the same commands, to rounding."""
    settings = {"ground": ground, "conditions": conditions, "options": options}
    ours = CompiledPlant(robot, 3, **settings)  # type: ignore[arg-type]
    theirs = ExudynPlant(robot, 3, **settings)  # type: ignore[arg-type]
    assert apart(ours, theirs, (*PLACES, *FORCES, *SPEEDS)) < 1e-12
    for tick in range(round(seconds / duration)):
        for plant in (ours, theirs):
            trot(plant, tick, duration)
        assert apart(ours, theirs, PLACES) < 1e-11
        assert apart(ours, theirs, (*FORCES, *SPEEDS)) < 1e-9
        assert ours.fell is theirs.fell is False
    np.testing.assert_allclose(ours.grf(), theirs.grf(), atol=1e-9)
    assert (ours.time, ours.mass) == (theirs.time, theirs.mass)


GROUNDS = (*WALKED, Obstacles(roughness=0.3, seed=1, slope=-0.05))


@pytest.mark.parametrize("ground", GROUNDS, ids=repr)
def test_on_every_ground_the_robot_moves_as_in_exudyn(ground: Ground) -> None:
    assert_same(ROBOT, 10.0, ground=ground)


@pytest.mark.parametrize(
    "robot",
    [load_robot("hexapod"), load_robot("octopod"), odd_robot(), full_robot(), every_chain()],
)
def test_every_robot_moves_as_in_exudyn(robot: RobotDescription) -> None:
    assert_same(robot)


@pytest.mark.parametrize("name", ["C2", "C3", "C4", "S1", "S2", "S3"])
def test_under_every_condition_the_robot_moves_as_in_exudyn(name: str) -> None:
    assert_same(ROBOT, conditions=named_conditions(name, ROBOT))


@pytest.mark.parametrize("duration", [TICK, 1 / 50, 1 / 240])
@pytest.mark.parametrize("robot", [LATE, DULL], ids=["late", "dull"])
def test_late_servos_and_sensors_are_those_of_exudyn(
    robot: RobotDescription, duration: float
) -> None:
    assert_same(robot, 1.0, duration=duration)


def test_start_and_gravity_are_those_of_exudyn() -> None:
    options = PlantOptions(gravity=3.7, clearance=0.01, start_hip=0.1, start_knee=-0.2, step=1e-3)
    assert_same(ROBOT, 1.0, options=options)


def test_conditions_that_change_on_the_way_are_those_of_exudyn() -> None:
    plants = CompiledPlant(ROBOT, 1), ExudynPlant(ROBOT, 1)
    for k, conditions in enumerate(
        (Conditions(damaged=("LH",)), Conditions(held_at=0.03, grf_noise=0.1), Conditions())
    ):
        for plant in plants:
            plant.set_conditions(conditions)
        for tick in range(40):
            for plant in plants:
                trot(plant, 40 * k + tick)
        assert apart(*plants, PLACES) < 1e-11
        assert apart(*plants, FORCES) < 1e-9


@pytest.mark.parametrize(
    "robot", [ROBOT, LATE, load_robot("hexapod"), odd_robot(), full_robot(), every_chain()]
)
@pytest.mark.parametrize("ground", [Plane(slope=0.05), Obstacles(roughness=0.5)], ids=repr)
def test_legs_side_by_side_have_the_bits_of_one_after_the_other(
    robot: RobotDescription, ground: Ground
) -> None:
    plants = [CompiledPlant(robot, 5, ground=ground, kind=kind) for kind in KINDS]
    for tick in range(120):
        for plant in plants:
            trot(plant, tick)
    ours, theirs = (plant.sample() for plant in plants)
    for name, value in ours.items():
        np.testing.assert_array_equal(value, theirs[name], err_msg=name)


def test_an_unknown_kind_is_named() -> None:
    with pytest.raises(ValueError, match="kind 'wings' is not one of legs, scalar"):
        CompiledPlant(ROBOT, kind="wings")


def test_a_robot_of_one_leg_is_refused() -> None:
    middle = replace(ROBOT.legs[0], mount=(0.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="robots of 2 to 64 legs"):
        CompiledPlant(replace(ROBOT, legs=(middle,)))


def test_a_trace_has_a_row_a_tick() -> None:
    plant = CompiledPlant(ROBOT, 2)
    trace = plant.trace()
    samples = []
    for tick in range(5):
        trace.take()
        samples.append(plant.sample())
        trot(plant, tick)
    for name, values in trace.signals().items():
        np.testing.assert_array_equal(values, [sample[name] for sample in samples])
