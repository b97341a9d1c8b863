"""Which system an experiment is, and which it cannot be."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from apnc import Experiment
from apnc.system.structure import structure_of
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Obstacles, Plane, Waves
from apnc_plant.step import own_step
from apnc_plant.variables import Condition

BUILT_IN = {
    "servo.joint_damping", "servo.dry_friction", "servo.friction_speed", "servo.stop_stiffness",
    "servo.stop_damping", "servo.abduction", "servo.hip", "servo.knee",
}  # fmt: skip
"""Numbers of the robot that a plant FMU is built with and that are no start values."""


def plant_starts(experiment: Experiment, **numbers: float) -> dict[str, float]:
    named = {name.replace("_", ".", 1): value for name, value in numbers.items()}
    starts = structure_of(experiment, numbers=named).starts
    return {s.name: s.value for s in starts if s.component == "plant"}


def test_the_plant_starts_as_the_experiment_says() -> None:
    robot, usual = Experiment().description, plant_starts(Experiment())
    assert usual["step"] == own_step(robot) and usual["condition"] == Condition.C1.value
    for part in ("servo", "contact", "sensor"):
        for name, value in vars(getattr(robot, part)).items():
            if name != "component" and f"{part}.{name}" not in BUILT_IN:
                assert usual[f"{part}.{name}"] == value
    assert not BUILT_IN & set(usual)
    ground = Obstacles(slope=0.1, roughness=0.5, seed=7)
    own = Experiment(ground=ground, seed=7, step=1 / 1920, conditions="S3")
    changed = {"seed": 7, "roughness": 0.5, "slope": 0.1, "step": 1 / 1920, "condition": 7}
    assert plant_starts(own, servo_stiffness=20.0) == usual | changed | {"servo.stiffness": 20.0}
    assert plant_starts(Experiment(ground=Plane(slope=-0.1))) == usual | {"slope": -0.1}


@pytest.mark.parametrize(
    ("experiment", "words"),
    [
        (Experiment(mi=((0.0, 0.1), (5.0, 0.2))), "mi = "),
        (Experiment(turn=((0.0, 0.0), (5.0, 0.5))), "turn = "),
        (Experiment(reset=True), "reset = True"),
        (Experiment(seed=4294967299), "seed = 4294967299 of a system; allowed: 0 to 2147483647"),
        (Experiment(ground=Obstacles(roughness=0.5, seed=3)), "ground = obstacles:"),
        (Experiment(ground=Obstacles(roughness=0.5, density=9.0)), "ground = obstacles:"),
        (Experiment(ground=Waves()), "ground = waves"),
        (Experiment(ground=Plane(slope=1.55)), "slope = 1.55; allowed: a number from -1.5 to 1.5"),
        (Experiment(conditions=Conditions(grf_noise=0.1)), "conditions = "),
        (Experiment(conditions=((0.0, "C1"), (5.0, "S3"))), "conditions = "),
        (Experiment(robot=Experiment().description), "robot = "),
    ],
)
def test_what_a_system_cannot_hold_is_refused(experiment: Experiment, words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)) as error:
        structure_of(experiment)
    assert len(str(error.value).splitlines()) == 1


def test_a_controller_of_ones_own_is_refused(fmu4: Path) -> None:
    with pytest.raises(ValueError, match=r"fmu = .*\.fmu of a system; allowed: the built one"):
        structure_of(Experiment(fmu=str(fmu4)))


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ({"seed": 3}, "number 'seed' of the robot is not one of servo.stiffness, "),
        ({"servo.cow": 3}, "number 'servo.cow' of the robot is not one of"),
        ({"contact.friction": -1.0}, "contact.friction = -1.0; allowed: a number from 0 to 1000"),
    ],
)
def test_numbers_that_no_robot_has_are_refused(numbers: dict[str, float], words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        structure_of(Experiment(), numbers=numbers)


@pytest.mark.parametrize(
    ("conditions", "condition", "payload"),
    [
        ("C4", Condition.C4, 0.0),
        (Conditions(payload=0.5), Condition.C1, 0.5),
        (Conditions(payload=1.25), Condition.C1, 1.25),
        (Conditions(stuck={"right_front": 0.9, "FL": 0.9}, payload=0.5), Condition.S2, 0.5),
    ],
)
def test_a_payload_comes_on_top_of_a_condition(
    conditions: str | Conditions, condition: Condition, payload: float
) -> None:
    starts = plant_starts(Experiment(conditions=conditions))
    assert (starts["condition"], starts["payload"]) == (condition.value, payload)
