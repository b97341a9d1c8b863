"""An experiment says everything a run depends on, and is checked when it is made."""

from __future__ import annotations

import json
import pickle
import re
import sys
import zipfile
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from apnc import Conditions, Experiment, Obstacles, load_robot
from apnc.loop.as_dict import to_dict
from apnc.loop.code import code_hash, hash_of_package
from apnc.loop.provenance import what_was_run
from apnc_core.enumerations import Method


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"mi": 1.5}, "mi: 1.5 is not in 0 ... 1"),
        ({"mi": ((0, 0.1), (2, 7))}, "mi: 7 is not in 0 ... 1"),
        ({"mi": True}, "mi: True is not a number"),
        ({"turn": -2}, "turn: -2 is not in -1 ... 1"),
        ({"reset": 1}, "reset: 1 is not true or false"),
        ({"controller": "cow"}, "controller 'cow' is not one of apnc, apc"),
        ({"preset": "cow"}, "preset 'cow' is not one of robot, lilibot, paper"),
        ({"seed": -1}, "seed is -1; allowed: a whole number from 0"),
        ({"seed": 0.5}, "seed is 0.5; allowed: a whole number from 0 to 2^64 - 1"),
        ({"seed": 2**64}, "allowed: a whole number from 0 to 2^64 - 1"),
        ({"ground": 0.5}, "ground: 0.5 is not a ground"),
        ({"rate": 0}, "rate = 0.0 Hz is not in 1 ... 10000 Hz"),
        ({"rate": 1e9}, "is not in 1 ... 10000 Hz"),
        ({"duration": 0}, "duration = 0.0 s is not a positive time"),
        ({"duration": float("inf")}, "duration is inf; allowed: a finite number"),
        ({"duration": 1e308}, "duration = 1e+308 s is not a positive time"),
        ({"duration": 0.008}, "duration = 0.008 s is not one tick; allowed: 0.01667 s and more"),
        ({"step": 0.0}, "step is 0.0"),
        ({"settings": {"cow": 1}}, "parameter 'cow' is not one of"),
        (
            {"settings": {"method": "apc"}},
            "method = apc is not set here, but by controller",
        ),
        ({"settings": {"phi_stored": [1.0]}}, "phi_stored has 1 values; 4 legs take 3 or none"),
        ({"conditions": "C9"}, "conditions: 'C9' is not one of C1, C2"),
        ({"conditions": Conditions(damaged=("RM",))}, "leg 'RM' is not one of RF, RH, LF, LH"),
        ({"conditions": ((0, "C1"), (1, "C4"))}, "payload changes during the run: [0.0, 1.25] kg"),
        ({"robot": "cow"}, "robot 'cow' is unknown"),
    ],
)
def test_what_cannot_be_run_is_refused(change: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        Experiment(**change)


def test_ticks_are_whole_and_of_the_update_rate() -> None:
    assert (Experiment(duration=2).ticks, Experiment(duration=2, rate=50).ticks) == (120, 100)
    assert Experiment(duration=0.02).ticks == 1
    assert Experiment(rate=50).parameters()["Ts"] == 0.02


def test_the_preset_of_the_robot_is_its_own_and_settings_win() -> None:
    robot = replace(load_robot("lilibot"), controller={"xi": 0.07, "B_f": 0.03})
    own = Experiment(robot=robot, settings={"B_f": 0.04}).parameters()
    assert (own["xi"], own["B_f"]) == (0.07, 0.04)
    default = Experiment().parameters()["xi"]
    assert Experiment(robot=robot, preset="lilibot").parameters()["xi"] == default != 0.07
    rates = (Experiment(preset=name).parameters()["B_f"] for name in ("paper", "lilibot"))
    assert next(rates) != next(rates)


def test_settings_of_a_controller_stand_between_those_of_robot_and_experiment() -> None:
    name = "gamma_tegotae"
    robot = replace(load_robot("lilibot"), controller={name: 0.7})
    assert Experiment(robot=robot).parameters()[name] == 0.7
    for label, gain in (("tegotae", 0.015), ("tegotae_best", 0.15)):
        found = Experiment(robot=robot, controller=label)
        assert (found.parameters()[name], found.controller_name) == (gain, label)
        assert found.parameters()["method"] is Method.tegotae
        assert Experiment(controller=label, preset="paper").parameters()[name] == gain
    set_too = Experiment(robot=robot, controller="tegotae", settings={name: 0.2})
    assert set_too.parameters()[name] == 0.2
    same = Experiment(controller="tegotae", settings={name: 0.15})
    assert same.key() == Experiment(controller="tegotae_best").key()
    assert same.command() == "apnc walk --controller tegotae --set=gamma_tegotae=0.15"


def test_the_weight_is_that_of_the_robot() -> None:
    for name in ("lilibot", "hexapod", "octopod"):
        robot = load_robot(name)
        assert Experiment(robot=name).parameters()["robot_weight"] == robot.weight
    assert Experiment(controller="tegotae").parameters()["method"] is Method.tegotae


def test_equal_experiments_are_equal_however_their_numbers_came() -> None:
    a = Experiment(seed=3, settings={"kappa_rule": "printed", "phi_stored": [1, 2, 3]})
    b = Experiment(seed=np.int64(3), settings={"kappa_rule": 2, "phi_stored": (1.0, 2.0, 3.0)})  # type: ignore[arg-type]
    assert a == b
    assert a.key() == b.key()
    assert a.command() == b.command()
    assert a.to_dict() == json.loads(json.dumps(b.to_dict()))


CHANGES: list[dict[str, Any]] = [
    {"robot": "hexapod"},
    {"mi": 0.09},
    {"mi": ((0, 0.08), (5, 0.09))},
    {"duration": 44},
    {"seed": 1},
    {"controller": "apc"},
    {"preset": "paper"},
    {"settings": {"xi": 0.05}},
    {"ground": Obstacles(roughness=0.5)},
    {"ground": Obstacles(roughness=0.5, seed=1)},
    {"conditions": "C2"},
    {"turn": 0.1},
    {"reset": True},
    {"rate": 50},
    {"step": 1e-3},
    {"engine": "mujoco"},
]


def test_the_key_is_another_for_whatever_changes() -> None:
    keys = [Experiment().key(), *(Experiment(**change).key() for change in CHANGES)]
    assert len(set(keys)) == len(keys)
    assert all(re.fullmatch("[0-9a-f]{16}", key) for key in keys)


def test_the_key_sees_into_the_robots_file_and_the_fmu(fmu4: Path, tmp_path: Path) -> None:
    robot = load_robot("lilibot")
    slippery = replace(robot, contact=replace(robot.contact, friction=0.1))
    assert Experiment(robot=slippery).key() != Experiment(robot=robot).key()
    fmu = tmp_path / "x.fmu"
    fmu.write_bytes(fmu4.read_bytes())
    keys = {Experiment(fmu=str(fmu)).key()}
    with zipfile.ZipFile(fmu, "a") as archive:
        archive.comment = b"another"
    keys.add(Experiment(fmu=str(fmu)).key())
    assert len(keys) == 2


def test_the_key_sees_the_code(monkeypatch: pytest.MonkeyPatch) -> None:
    before = Experiment().key()
    monkeypatch.setattr("apnc.loop.experiment.code_hash", lambda: "another")
    assert Experiment().key() != before


@pytest.mark.parametrize(
    ("file", "counts"),
    [
        ("apnc/loop/simulate.py", True),
        ("apnc/studies/mi/__init__.py", True),
        ("apnc_plant/robot/robots/lilibot.toml", True),
        ("fmu_src/core/cpg.h", True),
        ("apnc_core/__init__.py", True),  # the version
        ("apnc/report/page.py", False),
        ("apnc/studies/mi/figures.py", False),
        ("apnc/notes.md", False),
    ],
)
def test_an_edit_is_other_code_but_not_one_of_what_only_shows(
    file: str, counts: bool, tmp_path: Path
) -> None:
    path = tmp_path / "a" / file
    path.parent.mkdir(parents=True)
    path.write_text("x")
    before = code_hash(tmp_path / "a")
    (tmp_path / "a").rename(tmp_path / "b")
    (tmp_path / "b" / file).write_text("y")
    assert (code_hash(tmp_path / "b") != before) == counts


@pytest.mark.parametrize(
    ("file", "counts"),
    [("measure.py", True), ("part/measure.py", True), ("figures.py", False), ("docs/x.py", False)],
)
def test_an_edit_of_a_package_with_studies_is_other_code(
    file: str, counts: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "own_studies" / file
    path.parent.mkdir(parents=True)
    (tmp_path / "own_studies" / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(str(tmp_path))
    found = []
    for text in "xy":
        path.write_text(text)
        hash_of_package.cache_clear()
        found.append(hash_of_package("own_studies.part"))
    del sys.modules["own_studies"]
    assert "" not in found
    assert (found[0] != found[1]) == counts


def test_the_product_has_no_hash_besides_that_of_the_experiment() -> None:
    assert hash_of_package("apnc.studies") == ""


def test_the_same_parameters_said_otherwise_have_the_same_key() -> None:
    default = Experiment().parameters()["xi"]
    assert Experiment(settings={"xi": default}).key() == Experiment().key()
    assert Experiment(preset="lilibot").key() == Experiment().key()
    assert Experiment(conditions=Conditions()).key() == Experiment(conditions="C1").key()


@pytest.mark.parametrize("change", CHANGES)
def test_what_was_run_is_plain_json(change: dict[str, Any]) -> None:
    experiment = Experiment(**change)
    said = json.loads(json.dumps(what_was_run(experiment), allow_nan=False))
    assert said["key"] == experiment.key()
    assert said["command"] == experiment.command()
    assert said["parameters"]["method"] == experiment.controller
    assert {"apnc", "exudyn", "code", "fmpy", "numpy", "python"} <= set(said["versions"])
    assert set(experiment.changed()) == set(change)


def test_conditions_of_the_paper_have_their_name_in_the_command() -> None:
    assert Experiment(conditions=Conditions(payload=1.25)).command().endswith("--condition C4")


ODD = replace(load_robot("hexapod"), controller={"xi": 0.07, "kappa_rule": "printed"})
OBJECTS = Experiment(
    robot=ODD,
    mi=[[0, 0.1], [5, 0.2]],  # type: ignore[arg-type]  # lists, as from JSON
    settings={"xi": 0.05, "phi_stored": [1, 2, 3, 1, 1]},
    conditions=((0, "C1"), (3, Conditions(stuck={"RF": 0.9}, damaged=["LH"]))),  # type: ignore[arg-type]
    ground=Obstacles(roughness=0.3),
    duration=10,
)


@pytest.mark.parametrize("experiment", [Experiment(), OBJECTS])
def test_an_experiment_cannot_change_and_survives_every_way_of_copying(
    experiment: Experiment,
) -> None:
    conditions = experiment.conditions[-1][-1] if experiment is OBJECTS else Conditions()
    assert isinstance(conditions, Conditions)
    for frozen in (experiment.settings, experiment.description.controller, conditions.stuck):
        with pytest.raises(TypeError):
            frozen["xi"] = 0.5  # type: ignore[index]
    through_json = Experiment.from_dict(json.loads(json.dumps(experiment.to_dict())))
    copies = (deepcopy(experiment), pickle.loads(pickle.dumps(experiment)), through_json)
    assert {experiment, *copies} == {experiment}
    for copied in copies:
        assert copied.key() == experiment.key()
        assert copied.description == experiment.description


def test_legs_have_other_names_too() -> None:
    named = [Conditions(damaged=(name,)) for name in ("RF", "FR", "right front")]
    keys = {Experiment(conditions=each).key() for each in named}
    assert keys == {Experiment(conditions="C3").key()}
    assert {Experiment(conditions=each).command() for each in named} == {"apnc walk --condition C3"}
    stuck = Conditions(stuck={"FR": 0.9, "RF": 0.8})
    with pytest.raises(ValueError, match=r"^leg 'RF' is stuck twice, also as 'RF'; allowed: once"):
        Experiment(conditions=stuck)


def test_whole_numbers_are_the_numbers_they_are() -> None:
    whole = Experiment(duration=20, rate=50, mi=((0, 0.1), (5, 1)), turn=0)
    same = Experiment(duration=20.0, rate=50.0, mi=((0.0, 0.1), (5.0, 1.0)), turn=0.0)
    assert (whole.key(), whole.to_dict()) == (same.key(), same.to_dict())


def test_conditions_come_back_from_plain_data() -> None:
    own = Conditions(payload=0.0, damaged=("RF",), stuck={"LF": 0.5}, dropout=("*",))
    for conditions in (own, ((0.0, "C1"), (2.0, own))):
        experiment = Experiment(conditions=conditions)
        assert Experiment.from_dict(json.loads(json.dumps(experiment.to_dict()))) == experiment


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"robot": {"name": "x"}}, "not an experiment: "),
        ({"robot": {**to_dict(load_robot("lilibot")), "sensor": {"delay": -1.0}}}, "delay is -1.0"),
        ({"cow": 1}, "not an experiment: "),
        ({"reset": "maybe"}, "reset: 'maybe' is not true or false"),
        ({"mi": [0.1, 0.2]}, "not an experiment: "),
        ({"conditions": {"cow": 1}}, "not an experiment: "),
        ({"ground": {"kind": "moon"}}, "ground 'moon' is not one of"),
        ({"ground": "plane"}, "not an experiment: "),
        ({"settings": None}, "settings is None; allowed: a table"),
        ({"conditions": {"stuck": 5}}, "not an experiment: "),
    ],
)
def test_other_data_is_no_experiment(change: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        Experiment.from_dict(Experiment().to_dict() | change)


@pytest.mark.parametrize("data", ["text", [1, 2], None, {}])
def test_nor_is_anything_but_a_table(data: Any) -> None:
    with pytest.raises(ValueError, match="not an experiment: "):
        Experiment.from_dict(data)


def test_no_command_stands_for_an_object_that_has_no_name() -> None:
    slippery = load_robot("lilibot")
    slippery = replace(slippery, contact=replace(slippery.contact, friction=0.3))
    assert Experiment(robot=load_robot("lilibot")).command() == "apnc walk --robot lilibot"
    command = Experiment(robot=slippery, conditions=Conditions(damaged=("LH",))).command()
    assert command == "# from Python only: robot 'lilibot' and conditions given as an object"
