"""An experiment says everything that a run depends on, and refuses what cannot be run."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest

from apnc import Conditions, Experiment, Ground, load_robot
from apnc.loop.steps import Course, parse_steps, steps_text


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"mi": 7.0}, "mi = 7.0 is not in 0 ... 1"),
        ({"mi": float("nan")}, "mi = nan is not in 0 ... 1"),
        ({"mi": True}, "mi = True is not in 0 ... 1"),
        ({"mi": "fast"}, "mi = fast is not in 0 ... 1"),
        ({"mi": ((1.0, 0.1),)}, "steps of mi start at [1.0] s"),
        ({"mi": ((0.0, 0.1), (0.0, 0.2))}, "steps of mi start at [0.0, 0.0] s"),
        ({"mi": ((0.0, 0.1), (5.0, 1.2))}, "mi = 1.2 is not in 0 ... 1"),
        ({"mi": ()}, "steps of mi start at [] s"),
        ({"turn": -1.5}, "turn = -1.5 is not in -1 ... 1"),
        ({"reset": 1}, "reset = 1 is not true or false"),
        ({"duration": -3.0}, "duration = -3.0 s is not a positive time"),
        ({"duration": float("inf")}, "duration = inf s is not a positive time"),
        ({"duration": 0.001}, "duration = 0.001 s is not one tick"),
        ({"seed": -1}, "seed = -1 is not a whole number"),
        ({"seed": 1.5}, "seed = 1.5 is not a whole number"),
        ({"method": "cow"}, "method 'cow' is not one of apnc, apc, tegotae, phase_reset"),
        ({"preset": "cow"}, "preset 'cow' is not one of robot, lilibot, paper"),
        ({"rate": 0.0}, "rate = 0.0 Hz is not in 1 ... 10000 Hz"),
        ({"rate": float("nan")}, "rate = nan Hz"),
        ({"step": 0.0}, "step is 0.0"),
        ({"contact": "cow"}, "contact 'cow' is not one of compiled, exudyn"),
        ({"robot": "cow"}, "robot 'cow' is unknown"),
        ({"conditions": "C9"}, "'C9'"),
        ({"conditions": Conditions(damaged=("RM",))}, "'RM'"),
        ({"conditions": ((0.0, "C1"), (5.0, "C4"))}, "payload changes during the run"),
        ({"ground": "mud"}, "ground = 'mud' is not a ground"),
        ({"settings": {"cow": 1.0}}, "parameter 'cow' is not one of"),
        ({"settings": {"Ts": 1.0}}, "Ts = 1.0 is not set here, but by rate"),
        ({"settings": {"stored": True, "phi_stored": (1.0, 2.0)}}, "phi_stored has 2 values"),
    ],
)
def test_what_cannot_be_run_is_refused_at_once(fields: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=r".") as caught:
        Experiment(**fields)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_parameters_are_preset_then_robot_then_settings() -> None:
    robot = replace(load_robot("lilibot"), controller={"a1": 0.2, "xi": 0.03})
    values = Experiment(robot=robot, settings={"xi": 0.04}, method="apc", rate=50.0).parameters()
    assert (values["a1"], values["xi"]) == (0.2, 0.04)
    assert values["Ts"] == 0.02
    assert values["robot_weight"] == pytest.approx(2.5 * 9.81)
    assert Experiment(robot=robot, preset="lilibot").parameters()["a1"] != 0.2
    assert Experiment(robot=robot, preset="paper").parameters()["a1"] == 0.14


def test_the_key_changes_with_everything_a_run_depends_on() -> None:
    robot = load_robot("lilibot")
    slippery = replace(robot, contact=replace(robot.contact, friction=0.5))
    others = [
        Experiment(robot=slippery),
        Experiment(mi=0.1),
        Experiment(mi=((0.0, 0.08), (5.0, 0.1))),
        Experiment(duration=44.0),
        Experiment(seed=1),
        Experiment(method="apc"),
        Experiment(preset="paper"),
        Experiment(settings={"xi": 0.03}),
        Experiment(ground=Ground(roughness=0.5)),
        Experiment(ground=Ground(roughness=0.5, seed=1)),
        Experiment(ground=Ground(slope=0.1)),
        Experiment(conditions="C2"),
        Experiment(conditions=((0.0, "C1"), (5.0, "C2"))),
        Experiment(turn=0.5),
        Experiment(reset=True),
        Experiment(rate=50.0),
        Experiment(step=1e-3),
        Experiment(contact="exudyn"),
    ]
    keys = [Experiment().key(), *(other.key() for other in others)]
    assert len(set(keys)) == len(keys)


def test_the_key_is_the_same_however_a_thing_is_named() -> None:
    assert Experiment(robot=load_robot("lilibot")).key() == Experiment().key()
    assert Experiment(settings={"xi": 0.025}).key() == Experiment().key()
    assert (
        Experiment(conditions=Conditions(grf_noise=0.2)).key() == Experiment(conditions="C2").key()
    )


def test_plain_data_is_json() -> None:
    experiment = Experiment(
        robot=load_robot("hexapod"),
        conditions=((0.0, Conditions(stuck={"RF": 0.9})), (3.0, "C1")),
        settings={"kappa_rule": "printed", "stored": True, "phi_stored": (3.0, 0.1, 3.0, 0.1, 3.0)},
    )
    content = json.loads(json.dumps(experiment.to_dict(), allow_nan=False))
    assert content["conditions"][0][1]["stuck"] == {"RF": 0.9}
    assert content["robot"]["name"] == "hexapod"
    assert experiment.plain_parameters()["kappa_rule"] == "printed"


def test_the_command_names_what_is_not_default() -> None:
    assert Experiment().command() == "apnc walk"
    words = Experiment(mi=((0.0, 0.15), (5.0, 0.4)), conditions="C2", settings={"N": 60}).command()
    assert words == "apnc walk --mi 0:0.15,5:0.4 --set=N=60 --condition C2"


def test_a_course_holds_each_value_from_its_start_on() -> None:
    course = Course(((0.0, "a"), (1.0, "b"), (2.5, "c")))
    assert [course.at(t) for t in (0.0, 0.999, 1.0, 2.4, 2.5, 99.0)] == [
        "a",
        "a",
        "b",
        "b",
        "c",
        "c",
    ]
    assert Course(0.3).at(7.0) == 0.3


@pytest.mark.parametrize("value", [0.1, ((0.0, 0.15), (25.0, 0.4))])
def test_steps_have_words(value: Any) -> None:
    assert parse_steps(steps_text(value), float) == value


@pytest.mark.parametrize("text", ["0:0.1,cow", "0:cow", "moo:1"])
def test_words_that_are_no_steps_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="is not time:value"):
        parse_steps(text, float)
