"""The options of ``apnc walk`` say an experiment, and an experiment says its options."""

from __future__ import annotations

import json
import math
import re
import shlex
import tempfile
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import typer
from hypothesis import given, settings
from hypothesis import strategies as st

from apnc import Experiment, Gait, Kerb, Obstacles, Plane, Waves, write_gait
from apnc.cli.app import app
from apnc.cli.walk import experiment_of
from apnc.controllers import CONTROLLERS
from apnc.loop.experiment import conditions_of
from apnc.loop.provenance import what_was_run
from apnc.studies import terrain
from apnc_core.schema import Causality, Shape, Type
from apnc_core.variables import variables_of
from apnc_plant.robot import ROBOTS
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions, host_platform

COMMAND: Any = typer.main.get_command(app).commands["walk"]  # type: ignore[attr-defined]


def said(*words: str) -> Experiment:
    return experiment_of(COMMAND.make_context("walk", list(words)).params)


def over(values: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    times = st.lists(st.floats(1e-3, 1e7), unique=True, max_size=3).map(sorted)
    steps = times.flatmap(
        lambda starts: st.tuples(*(st.tuples(st.just(t), values) for t in [0.0, *starts]))
    )
    return values | steps


def value_of(v: Any) -> st.SearchStrategy[Any]:
    if v.shape is not Shape.scalar:
        return st.tuples(*[st.floats(v.min, v.max)] * 3)
    if v.enumeration:
        return st.sampled_from(list(v.enumeration.items))
    if v.type is Type.boolean:
        return st.booleans()
    return st.integers(v.min, v.max) if v.type is Type.integer else st.floats(v.min, v.max)


PARAMETERS = [v for v in variables_of(Causality.parameter) if v.name not in ("Ts", "method")]


SETTINGS = st.fixed_dictionaries({}, optional={v.name: value_of(v) for v in PARAMETERS})


SLOPES = st.floats(-1.5, 1.5)


GROUNDS = st.one_of(
    st.builds(Plane, slope=SLOPES),
    st.builds(Obstacles, slope=SLOPES, roughness=st.floats(0, 1), seed=st.integers(0, 10**9)),
    st.builds(Obstacles, diameters=st.tuples(st.floats(0.026, 0.05), st.floats(0.05, 1))),
    st.builds(Kerb, at=st.floats(-9, 9), height=st.floats(1e-4, 1.0)),
    st.builds(Waves),
)


@cache
def own_fmu() -> str:
    """An FMU whose own start values an experiment may set otherwise."""
    path = Path(FOLDER.name) / "my own.fmu"
    options = BuildOptions(platforms=(host_platform(),), settings={"Ts": 0.02, "xi": 0.07})
    path.write_bytes(cached_fmu(options).read_bytes())
    return str(path)


FOLDER = tempfile.TemporaryDirectory()


EXPERIMENTS = st.builds(
    Experiment,
    robot=st.just("lilibot"),
    mi=over(st.floats(0, 1)),
    duration=st.floats(0.1, 1e9),
    seed=st.integers(0, 2**32),
    controller=st.none() | st.sampled_from(list(CONTROLLERS)),
    preset=st.sampled_from(["robot", "lilibot", "paper"]),
    settings=SETTINGS,
    ground=GROUNDS,
    conditions=over(st.sampled_from(["C1", "C2", "C3", "S1", "S2", "S3"])) | st.just("C4"),
    turn=over(st.floats(-1, 1)),
    reset=over(st.booleans()),
    rate=st.floats(10, 1000),
    step=st.floats(1e-5, 1e-3),
    fmu=st.none() | st.deferred(lambda: st.just(own_fmu())),
)


@settings(max_examples=100, deadline=None)
@given(EXPERIMENTS)
def test_the_command_of_an_experiment_says_it_again(experiment: Experiment) -> None:
    name, command, *words = shlex.split(experiment.command())
    assert (name, command) == ("apnc", "walk")
    assert said(*words) == experiment
    assert Experiment.from_dict(json.loads(json.dumps(experiment.to_dict()))) == experiment


FIELDS = {f.name: f.name for f in fields(Experiment)} | {"condition": "conditions"}
"""Field of an experiment by the name of its option."""


@pytest.mark.parametrize("robot", ["hexapod", "own.toml"])
def test_robots_by_name_and_by_file(
    robot: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from apnc_plant.robot import ROBOTS  # noqa: PLC0415

    monkeypatch.chdir(tmp_path)
    Path("own.toml").write_text((ROBOTS / "lilibot.toml").read_text())
    experiment = Experiment(robot=robot)
    assert said(*shlex.split(experiment.command())[2:]) == experiment


def test_no_option_is_the_default_experiment_and_the_help_tells_its_values() -> None:
    assert said() == Experiment()
    for parameter in COMMAND.params:
        if parameter.name in FIELDS and (told := re.search(r"Default: ([\w.]*\w)", parameter.help)):
            # what is told of MI holds for a robot without one of its own
            walk = Experiment(robot="hexapod") if parameter.name == "mi" else Experiment()
            value = getattr(walk, FIELDS[parameter.name])
            assert told[1].lower() == getattr(value, "kind", str(value).lower()), parameter.name


def test_short_forms_of_the_ground() -> None:
    assert said("--slope", "5").ground == Plane(slope=math.radians(5))
    assert said("--roughness", "0.5", "--seed", "3").ground == Obstacles(roughness=0.5, seed=3)
    steep = said("--ground", "kerb:height=0.01", "--slope", "-5").ground
    assert steep == Kerb(height=0.01, slope=math.radians(-5))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--ground", "kerb", "--roughness", "0.5"], "--ground kerb and --roughness 0.5"),
        (["--ground", "kerb:slope=0.1", "--slope", "3"], "both say the slope"),
        (["--ground", "moon"], "ground 'moon' is not one of"),
        (["--reset", "maybe"], "reset = 'maybe' is not a value"),
        (["--mi", "0:0.1,soon:0.2"], "mi = '0:0.1,soon:0.2' is not a value"),
        (["--turn", "1:0.1"], "turn: steps start at"),
        (["--condition", "0:C1,5:C4"], "payload changes during the run"),
        (["--slope", "90"], "slope is 1.57"),
        (["--params", "no.json"], "no.json: cannot be read"),
        (["--robot", "hexapod", "--gait", "gait.json"], "the gait is of legs RF, RH, LF, LH"),
    ],
)
def test_what_does_not_fit_is_said_before_the_run(
    words: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_gait(Gait(("RF", "RH", "LF", "LH"), (3.1, 3.1, 0.0)), Path("gait.json"))
    with pytest.raises(ValueError, match=re.escape(message)):
        said(*words)


def test_a_condition_is_of_the_leg_at_its_place_whatever_its_name(tmp_path: Path) -> None:
    path = tmp_path / "other.toml"
    path.write_text((ROBOTS / "lilibot.toml").read_text().replace('"RF"', '"FR"'))
    found = said("--robot", str(path), "--condition", "C3")
    assert conditions_of(found.conditions, found.description).damaged == ("FR",)


def test_a_summary_gives_its_parameters_to_another_run(tmp_path: Path) -> None:
    before = Experiment(
        controller="tegotae", rate=100, settings={"xi": 0.05, "kappa_rule": 2, "robot_weight": 30.0}
    )
    path = tmp_path / "summary.json"
    path.write_text(json.dumps(what_was_run(before)))
    assert said("--params", str(path)).parameters() == before.parameters()
    # what is said on the command line wins, and what a controller set goes with it
    after = said("--params", str(path), "--set", "xi=0.5", "--rate", "50", "--controller", "apc")
    assert after.settings == {**before.settings, "xi": 0.5}
    assert (after.rate, after.controller) == (50.0, "apc")


def test_a_controller_that_is_named_replaces_that_of_a_summary_with_its_settings(
    tmp_path: Path,
) -> None:
    path = tmp_path / "summary.json"
    path.write_text(json.dumps(what_was_run(Experiment(controller="tegotae_best"))))
    assert said("--params", str(path)).parameters()["gamma_tegotae"] == 0.15
    for label in ("tegotae", "apnc"):
        found = said("--params", str(path), "--controller", label)
        assert found.parameters() == Experiment(controller=label).parameters()
    own = Experiment(controller="tegotae_best", settings={"gamma_tegotae": 0.4})
    path.write_text(json.dumps(what_was_run(own)))
    found = said("--params", str(path), "--controller", "tegotae")
    assert found.parameters()["gamma_tegotae"] == 0.4  # set in that walk, so it is taken


def test_the_weight_of_another_robot_is_not_taken(tmp_path: Path) -> None:
    path = tmp_path / "summary.json"
    path.write_text(json.dumps(what_was_run(Experiment(settings={"xi": 0.05}))))
    hexapod = said("--params", str(path), "--robot", "hexapod")
    assert hexapod.robot == "hexapod"
    assert hexapod.settings["xi"] == 0.05
    assert "robot_weight" not in hexapod.settings


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("p.json", '{"xi": 0.05, "kappa_rule": "printed", "Ts": 0.02}'),
        ("p.toml", 'xi = 0.05\nkappa_rule = "printed"\nTs = 0.02'),
    ],
)
def test_plain_files_of_parameters(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    experiment = said("--params", str(tmp_path / name))
    assert experiment == Experiment(rate=50.0, settings={"xi": 0.05, "kappa_rule": 2})


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("p.json", "{", "p.json: not readable as JSON"),
        ("p.json", "[1]", "p.json: not a table"),
        ("p.json", '{"cow": 1}', "p.json: parameter 'cow' is not one of"),
        ("p.json", '{"N": 3.7}', "p.json: N = 3.7; allowed: a whole number"),
        ("p.toml", "xi = [1]", "p.toml: xi = [1]"),
        ("p.ssv", "<x/>", "p.ssv is not an SSV file"),
        ("p.ssv", b"\xff\xfe", "p.ssv is not an SSV file"),
        (
            "p.json",
            b'{"xi": \xff}',
            "p.json: not readable as JSON ('utf-8' codec can't decode byte 0xff",
        ),
        (
            "p.toml",
            b"xi = \xff",
            "p.toml: not readable as TOML ('utf-8' codec can't decode byte 0xff",
        ),
        ("p.json", "[" * 100_000, "p.json: not readable as JSON (maximum recursion depth"),
        ("p.json", '"text"', "p.json: not a table"),
        ("p.json", '{"parameters": "text"}', "p.json: parameters is 'text'; allowed: a table"),
        (
            "p.json",
            '{"parameters": {}, "experiment": "text"}',
            "p.json: experiment is 'text'; allowed: a table",
        ),
        (
            "p.json",
            '{"parameters": {}, "experiment": {"settings": null}}',
            "p.json: experiment.settings is None; allowed: a table",
        ),
    ],
)
def test_a_bad_file_of_parameters_is_named(
    name: str, text: str | bytes, words: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(text.encode() if isinstance(text, str) else text)
    with pytest.raises(ValueError, match=re.escape(words)):
        said("--params", str(tmp_path / name))


def test_memory_begins_where_the_gait_ended_and_set_wins(tmp_path: Path) -> None:
    gait = Gait(("RF", "RH", "LF", "LH"), (3.1, 3.2, 0.1))
    write_gait(gait, tmp_path / "gait.json")
    words = ("--gait", str(tmp_path / "gait.json"))
    assert said(*words).settings == {"stored": True, "phi_stored": gait.phi}
    assert said(*words, "--set", "stored=false").settings["stored"] is False


def test_roughness_is_of_obstacles_of_the_robots_size(tmp_path: Path) -> None:
    text = (ROBOTS / "lilibot.toml").read_text(encoding="utf-8")
    path = tmp_path / "large.toml"
    for length in ("femur_length = 0.070", "tibia_length = 0.085"):
        name, _, value = length.partition(" = ")
        text = text.replace(length, f"{name} = {2.0 * float(value)}")
    path.write_text(text, encoding="utf-8")
    found = said("--robot", str(path), "--roughness", "0.5", "--seed", "2")
    assert found.ground == Obstacles(roughness=0.5, seed=2, scale=2.0)
    assert said(*shlex.split(found.command())[2:]) == found
    assert said("--roughness", "0.5").ground == Obstacles(roughness=0.5)
    assert terrain.experiment(2, 0.5, robot=str(path)).ground == found.ground
