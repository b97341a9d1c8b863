"""The integration step of a robot: the one that it gets, and the longest that is allowed."""

from __future__ import annotations

import weakref
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from made_up_robots import heavy, stiff_kneed
from plain_robot import plain_robot
from plants import Kind, in_both
from unchecked import any_step

from apnc_plant.compiled import CompiledPlant
from apnc_plant.numbers import Numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.signals import PlantError
from apnc_plant.step import checked_step, longest_step, own_step, stable_step
from mujoco_models.plant import MujocoPlant

TICK = 1 / 60
ROBOT = plain_robot()


@pytest.mark.parametrize(("name", "steps"), [("lilibot", 24), ("hexapod", 16), ("octopod", 16)])
def test_steps_of_the_shipped_robots_in_a_tick(name: str, steps: int) -> None:
    assert own_step(load_robot(name)) == TICK / steps


@pytest.mark.parametrize("step", [longest_step, stable_step, own_step])
def test_the_arrays_of_a_robot_live_while_c_reads_them(
    step: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Arrays:
        """Stands for the legs that the numbers of a robot point to."""

    seen = []

    def numbers(robot: RobotDescription) -> Numbers:
        arrays = Arrays()
        return Numbers(weakref.ref(arrays), (arrays,))

    def read(at: Any) -> float:
        seen.append(at() is not None)
        return 0.001

    functions = ("plant_longest_step", "plant_stable_step", "plant_own_step")
    lib = SimpleNamespace(**dict.fromkeys(functions, read))
    monkeypatch.setattr("apnc_plant.step.robot_numbers", numbers)
    monkeypatch.setattr("apnc_plant.step.library", lambda: (None, lib))
    step.__wrapped__(ROBOT)
    assert seen == [True]


@pytest.mark.parametrize("robot", [stiff_kneed(), heavy()], ids=lambda robot: robot.name)
def test_a_robot_that_needs_a_shorter_step_gets_it(robot: RobotDescription) -> None:
    step, longest = own_step(robot), longest_step(robot)
    assert step < 1.0 / 960.0
    assert step <= longest / 1.4
    assert (1.0 / 480.0 / step) % 1.0 == pytest.approx(0.0)
    assert 1.0 / (1.0 / step - 480.0) > longest / 1.4  # the next longer one is too long


@pytest.mark.parametrize(
    "change",
    [
        {"servo": {"damping": 3.0}},
        {"servo": {"stiffness": 2000.0}},
        {"servo": {"stall_torque": 20.0}},
        {"servo": {"reflected_inertia": 0.003}},
        {"contact": {"damping": 900.0}},
        {"contact": {"stiffness": 400000.0}},
        {"contact": {"friction": 1.6}},
        {"contact": {"friction_speed": 0.02}},
        {"trunk": {"mass": 4.0}},
    ],
    ids=str,
)
def test_what_is_stiffer_lighter_or_slips_less_needs_a_shorter_step(
    change: dict[str, dict[str, float]],
) -> None:
    parts = {name: replace(getattr(ROBOT, name), **new) for name, new in change.items()}
    assert longest_step(replace(ROBOT, **parts)) < 0.99 * longest_step(ROBOT)


@in_both
def test_a_step_that_is_too_long_is_refused_with_the_limit(kind: Kind) -> None:
    for plant in (kind, MujocoPlant):
        with pytest.raises(ValueError, match=r"^step = 0\.0042 s is too long") as refused:
            plant(ROBOT, options=PlantOptions(step=0.0042))
    line = str(refused.value)
    assert "servos and feet of robot 'plain'; allowed: 0.002185 s and less" in line
    kind(ROBOT, options=PlantOptions(step=0.002185))


def test_the_limit_that_is_said_is_allowed() -> None:
    for scale in np.linspace(1.0, 10.0, 50):
        robot = replace(ROBOT, contact=replace(ROBOT.contact, damping=430.0 * scale))
        with pytest.raises(ValueError, match="too long") as refused:
            checked_step(1.0, robot)
        said = float(str(refused.value).split("allowed: ")[1].split()[0])
        assert checked_step(said, robot) == said
        assert said > 0.99 * longest_step(robot)


def test_a_robot_that_no_step_can_follow_is_refused() -> None:
    robot = replace(ROBOT, contact=replace(ROBOT.contact, stiffness=1e300))
    with pytest.raises(ValueError, match=r"'plain' are so stiff .* allowed: 1e-06 s and more$"):
        CompiledPlant(robot)


def hanging(speed_up: float, monkeypatch: pytest.MonkeyPatch) -> float:
    """Speed of the joints in a long time after a jerk of 1e-6 rad, without weight or ground.

    Args:
        speed_up: integration step over the longest stable one.
        monkeypatch: lets the step pass.
    """
    any_step(monkeypatch)
    soft = replace(ROBOT.contact, stiffness=1e-9, damping=0.0)
    servo = replace(ROBOT.servo, damping=2.0)
    robot = replace(ROBOT, contact=soft, servo=servo)
    step = speed_up * stable_step(robot)
    plant = CompiledPlant(robot, options=PlantOptions(step=step, gravity=0.0, clearance=1.0))
    plant.advance(np.array([1e-6, 0.0, 0.0, 0.0]), np.zeros(4), step)
    for _ in range(400):
        plant.advance(np.zeros(4), np.zeros(4), step)
    return float(np.abs(plant.sample()["joint_speed"]).max())


def test_vibrations_grow_with_steps_beyond_the_stable_one_only(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert hanging(0.98, monkeypatch) < 1e-6
    assert hanging(1.02, monkeypatch) > 1e-3


@in_both
@pytest.mark.parametrize("steps", [1, 2, 3])
def test_a_robot_that_vibrates_until_it_lies_down_has_not_fallen(
    kind: Kind, steps: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    any_step(monkeypatch)
    plant = kind(ROBOT, options=PlantOptions(step=TICK / steps))
    with pytest.raises(PlantError, match=rf"with integration steps of {TICK / steps:.4g} s$"):
        for tick in range(600):
            hip = 0.1 * np.sin(0.12 * tick) * np.array([1.0, -1.0, -1.0, 1.0])
            plant.advance(hip, 0.1 * np.cos(0.12 * tick) * np.ones(4), TICK)


@in_both
def test_a_robot_that_falls_with_a_stable_step_has_fallen(
    kind: Kind, monkeypatch: pytest.MonkeyPatch
) -> None:
    any_step(monkeypatch)
    step = 0.99 * stable_step(ROBOT)
    plant = kind(ROBOT, options=PlantOptions(step=step, start_hip=-0.8, start_knee=2.0))
    for _ in range(120):
        plant.advance(np.full(4, 1.5), np.full(4, 2.5), TICK)
        if plant.fell:
            break
    assert plant.fell
