"""Every plant against statics, closed form and itself."""

import gc
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from plain_robot import plain_text
from plants import AnyPlant, Kind, commands, in_both, stand
from unchecked import any_step

from apnc_core.interface import Parameters
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.signals import PLANT_SIGNALS, PlantError
from apnc_plant.step import own_step

TICK = 1 / 60
DIAGONAL = np.array([1.0, -1.0, -1.0, 1.0])
ROBOT = load_robot("lilibot")
DEFAULT = Parameters()


def trot(plant: AnyPlant, tick: int, duration: float = TICK) -> None:
    phase = 0.12 * tick
    hip = 0.13 * np.sin(phase) * DIAGONAL + DEFAULT.b1
    knee = 0.08 * np.cos(phase) * DIAGONAL + DEFAULT.b2
    plant.advance(hip, knee, duration)


def coordinates(plant: AnyPlant) -> np.ndarray:
    sample = plant.sample()
    return np.concatenate([np.ravel(value) for value in sample.values()])


@in_both
def test_sample_has_every_signal_in_its_shape(kind: Kind) -> None:
    sample = stand(kind, ROBOT, 0.1).sample()
    assert {name: value.shape for name, value in sample.items()} == {
        signal.name: signal.shape(4) for signal in PLANT_SIGNALS
    }


@in_both
def test_at_rest_the_ground_carries_the_weight_and_nothing_slides(kind: Kind) -> None:
    plant = stand(kind, ROBOT)
    sample = plant.sample()
    force = sample["foot_force"]
    assert force[:, 2].sum() == pytest.approx(plant.mass * 9.81, rel=1e-4)
    assert force[:, 2].min() > 1.0
    assert np.abs(force[:, :2]).max() < 0.01
    assert np.abs(sample["velocity"]).max() < 1e-5
    assert np.abs(sample["joint_speed"]).max() < 1e-4
    assert not plant.fell


@in_both
def test_feet_sink_in_by_load_over_stiffness(kind: Kind) -> None:
    sample = stand(kind, ROBOT).sample()
    penetration = ROBOT.contact.foot_radius - sample["foot_position"][:, 2]
    expected = sample["foot_force"][:, 2] / ROBOT.contact.stiffness
    np.testing.assert_allclose(penetration, expected, rtol=1e-3)


@in_both
def test_at_rest_the_sensor_delivers_the_load(kind: Kind) -> None:
    quiet = replace(ROBOT, sensor=replace(ROBOT.sensor, noise=0.0))
    plant = stand(kind, quiet)
    np.testing.assert_allclose(plant.grf(), plant.sample()["foot_force"][:, 2], rtol=1e-3)


@in_both
def test_the_load_arrives_late_and_smoothed(kind: Kind) -> None:
    quiet = replace(ROBOT, sensor=replace(ROBOT.sensor, noise=0.0, delay=0.05))
    plant = kind(quiet)
    loads, readings = [np.zeros(4)] * 3, []
    for tick in range(60):
        trot(plant, tick)
        loads.append(plant.sample()["foot_force"][:, 2])
        readings.append(plant.grf())
    for (before, now), late in zip(pairwise(readings), loads[1:], strict=False):
        np.testing.assert_allclose(now, 0.4 * before + 0.6 * late, atol=2e-3)


@in_both
def test_a_dropped_robot_lands_and_stays_on_its_feet(kind: Kind) -> None:
    plant = kind(ROBOT, options=PlantOptions(clearance=0.03))
    for _ in range(120):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    assert plant.sample()["foot_force"][:, 2].sum() == pytest.approx(plant.mass * 9.81, rel=1e-3)
    assert not plant.fell


@in_both
def test_an_open_loop_trot_walks_forward(kind: Kind) -> None:
    plant = kind(ROBOT)
    for tick in range(360):
        trot(plant, tick)
    assert 0.2 < plant.sample()["position"][0] < 0.7
    assert not plant.fell


@in_both
def test_the_default_step_is_fine_enough(kind: Kind) -> None:
    ends = []
    for step in (own_step(ROBOT), own_step(ROBOT) / 4):
        plant = kind(ROBOT, options=PlantOptions(step=step))
        for tick in range(180):
            trot(plant, tick)
        ends.append(plant.sample()["position"])
    np.testing.assert_allclose(ends[0], ends[1], atol=0.003)


@in_both
def test_same_seed_same_motion_bit_for_bit(kind: Kind) -> None:
    ends = []
    for seed in (3, 3, 4):
        plant = kind(ROBOT, seed)
        for tick in range(60):
            trot(plant, tick)
        ends.append(coordinates(plant))
    np.testing.assert_array_equal(ends[0], ends[1])
    assert not np.array_equal(ends[0], ends[2])


@in_both
def test_plants_in_one_process_do_not_touch_each_other(kind: Kind) -> None:
    alone = kind(ROBOT, 1)
    for tick in range(60):
        trot(alone, tick)
    first, other = kind(ROBOT, 1), kind(ROBOT, 2)
    for tick in range(60):
        trot(first, tick)
        if tick < 30:
            other.advance(np.full(4, 0.3), np.full(4, -0.3), TICK / 2)
        elif tick == 30:
            del other
            gc.collect()
    np.testing.assert_array_equal(coordinates(first), coordinates(alone))


@in_both
def test_time_adds_up_over_uneven_ticks(kind: Kind) -> None:
    plant = kind(ROBOT)
    for duration in (TICK, 0.01, 1e-4, 0.0333, 1e-6):
        plant.advance(np.zeros(4), np.zeros(4), duration)
    assert plant.time == pytest.approx(TICK + 0.01 + 1e-4 + 0.0333 + 1e-6, abs=1e-15)


@in_both
def test_a_fallen_robot_is_noticed(kind: Kind) -> None:
    assert not kind(ROBOT).fell
    # Legs folded up past the trunk: its lower corners are below the feet.
    assert kind(ROBOT, options=PlantOptions(start_hip=-0.8, start_knee=2.5)).fell


@in_both
def test_six_legs_are_another_file(kind: Kind, tmp_path: Path) -> None:
    middle = '[[legs]]\nname = "{}M"\nmount = [0.0, {}, 0.0]\n\n'
    more = middle.format("R", -0.066) + middle.format("L", 0.066) + "[servo]"
    path = tmp_path / "hexapod.toml"
    path.write_text(plain_text().replace("[servo]", more), encoding="utf-8")
    plant = stand(kind, load_robot(str(path)))
    assert plant.legs == ("RF", "RM", "RH", "LF", "LM", "LH")
    assert plant.mass == pytest.approx(3.1)
    assert plant.sample()["foot_force"][:, 2].sum() == pytest.approx(3.1 * 9.81, rel=1e-3)


@in_both
@pytest.mark.parametrize(
    ("hip", "duration", "message"),
    [
        (np.zeros(3), TICK, "theta_hip"),
        (np.full(4, np.nan), TICK, "theta_hip"),
        (np.zeros(4), 0.0, "duration"),
        (np.zeros(4), np.inf, "duration"),
    ],
)
def test_bad_commands_are_refused(
    kind: Kind, hip: np.ndarray, duration: float, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        kind(ROBOT).advance(hip, np.zeros(4), duration)


def test_bad_options_are_refused() -> None:
    with pytest.raises(ValueError, match="step is 0"):
        PlantOptions(step=0.0)


@in_both
def test_divergence_is_reported(kind: Kind, monkeypatch: pytest.MonkeyPatch) -> None:
    any_step(monkeypatch)
    plant = kind(ROBOT, options=PlantOptions(step=TICK))
    said = r"^the motion diverged before t = \d\.\d{4} s with integration steps of 0\.01667 s$"
    with pytest.raises(PlantError, match=said):
        for tick in range(600):
            trot(plant, tick)


def stands_on_all_feet(kind: Kind, robot: RobotDescription, *legs: str) -> None:
    plant = stand(kind, replace(robot, trunk=replace(robot.trunk, com_side_offset=0.0)))
    assert plant.legs == legs
    force = plant.sample()["foot_force"]
    assert force[:, 2].sum() == pytest.approx(plant.mass * 9.81, rel=1e-3)
    assert force[:, 2].min() > 1.0
    np.testing.assert_allclose(plant.sample()["rpy"], 0.0, atol=0.05)
    assert not plant.fell


@in_both
def test_a_hexapod_with_hips_of_one_height_stands_on_all_six_feet(kind: Kind) -> None:
    hexapod = load_robot("hexapod")
    level = tuple(replace(leg, mount=(*leg.mount[:2], 0.0)) for leg in hexapod.legs)
    stands_on_all_feet(kind, replace(hexapod, legs=level), "RF", "RM", "RH", "LF", "LM", "LH")


@in_both
def test_the_octopod_stands_on_all_eight_feet(kind: Kind) -> None:
    names = ("RF", "R2", "R3", "RH", "LF", "L2", "L3", "LH")
    stands_on_all_feet(kind, load_robot("octopod"), *names)


@in_both
def test_the_hexapod_walks_on_alternating_tripods(kind: Kind) -> None:
    plant = kind(load_robot("hexapod"))
    for tick in range(360):
        plant.advance(*commands(tick, 6), TICK)
    assert 0.2 < plant.sample()["position"][0] < 0.7
    assert not plant.fell
