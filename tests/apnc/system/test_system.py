"""The files of a system: what they say about the two FMUs, and what they leave out."""

from __future__ import annotations

import importlib.resources
import math
import re
import zipfile
from dataclasses import replace
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from apnc import Experiment
from apnc.cli import main as command_line
from apnc.loop.gait import Gait, write_gait
from apnc.system.build import build_system
from apnc.system.osp import osp
from apnc.system.structure import structure_of
from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_plant.conditions import CONDITIONS, Conditions
from apnc_plant.ground import Obstacles, Plane, Waves
from apnc_plant.variables import Condition

SSP = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"
OSP = "{http://opensimulationplatform.com/MSMI/OSPSystemStructure}"


@pytest.fixture(scope="module", params=["structured", "flat"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp(request.param) / "Lilibot.ssp"
    return build_system(output, Experiment(mi=0.15, seed=3), request.param)


def test_the_archive_is_the_folder_without_the_files_of_other_tools(folder: Path) -> None:
    with zipfile.ZipFile(folder.with_suffix(".ssp")) as archive:
        names = set(archive.namelist())
        assert names == {
            "SystemStructure.ssd",
            *(f"resources/{n}" for n in ("Apnc.fmu", "LilibotPlant.fmu")),
            *(f"resources/{n}" for n in ("controller.ssv", "plant.ssv")),
        }
        for name in names:
            assert archive.read(name) == (folder / name).read_bytes()
    assert {p.name for p in folder.iterdir() if p.is_file()} == {
        "SystemStructure.ssd", "OspSystemStructure.xml", "container.json", "system.h",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("name", "schema"),
    [
        ("SystemStructure.ssd", "Description"),
        ("resources/controller.ssv", "ParameterValues"),
        ("resources/plant.ssv", "ParameterValues"),
    ],
)
def test_its_files_are_those_of_ssp_1(name: str, schema: str, folder: Path) -> None:
    schemas = importlib.resources.files("fmpy.ssp") / "schema"
    xsd = etree.XMLSchema(file=str(schemas / f"SystemStructure{schema}.xsd"))
    xsd.assertValid(etree.parse(folder / name))
    assert etree.parse(folder / name).getroot().get("version") == "1.0"


def test_connectors_are_variables_of_the_fmus(folder: Path) -> None:
    root = etree.parse(folder / "SystemStructure.ssd").getroot()
    units = {u.get("name") for u in root.iterfind(f"{SSP}Units/*")}
    for component in root.iter(f"{SSP}Component"):
        description = fmpy.read_model_description(str(folder / component.get("source")))
        known = {v.name: v for v in description.modelVariables}
        for connector in component.iter(f"{SSP}Connector"):
            variable = known[connector.get("name")]
            assert variable.causality == connector.get("kind")
            assert variable.type == etree.QName(connector[0]).localname
            assert variable.unit == connector[0].get("unit")
            assert variable.unit is None or variable.unit in units


def ends(folder: Path) -> list[tuple[str, ...]]:
    keys = ("startElement", "startConnector", "endElement", "endConnector")
    root = etree.parse(folder / "SystemStructure.ssd").getroot()
    return [tuple(c.get(k) for k in keys) for c in root.iter(f"{SSP}Connection")]


def test_what_is_connected_has_one_name_and_no_input_is_left(folder: Path) -> None:
    root = etree.parse(folder / "SystemStructure.ssd").getroot()
    inputs = {
        (component.get("name"), connector.get("name"))
        for component in root.iter(f"{SSP}Component")
        for connector in component.iter(f"{SSP}Connector")
        if connector.get("kind") == "input"
    }
    connections = ends(folder)
    assert all(start == end for _, start, _, end in connections)
    # fmpy.ssp gives the others what the input listed before them gets
    assert {(part, name) for *_, part, name in connections} == inputs
    assert len(connections) == len(inputs) == 4 + 8
    bracketed = any("[" in start for _, start, *_ in connections)
    assert bracketed == ("structured" in str(folder))


def test_osp_connects_the_same(folder: Path) -> None:
    root = etree.parse(folder / "OspSystemStructure.xml").getroot()
    found = [
        tuple(v.get(key) for v in connection for key in ("simulator", "name"))
        for connection in root.iter(f"{OSP}VariableConnection")
    ]
    assert found == ends(folder)
    (step,) = root.iterfind(f"{OSP}BaseStepSize")
    assert step.text == "0.016666666"
    assert [s.get("stepSize") for s in root.iter(f"{OSP}Simulator")] == [step.text] * 2


@pytest.mark.parametrize(("rate", "step"), [(50.0, "0.020000000"), (90.0, "0.011111111")])
def test_the_step_of_osp_is_never_longer_than_a_tick(rate: float, step: str) -> None:
    """With longer ones two ticks fall into one step after a minute."""
    root = etree.fromstring(osp(structure_of(Experiment(rate=rate))))
    assert root.find(f"{OSP}BaseStepSize").text == step


def values(file: Path) -> dict[str, str]:
    root = etree.parse(file).getroot()
    return {p.get("name"): p[0].get("value") for p in root.iter(f"{SSV}Parameter")}


def test_the_parameter_sets_hold_the_preset(folder: Path, tmp_path: Path) -> None:
    controller = values(folder / "resources/controller.ssv")
    assert controller["MI"] == "0.15" and float(controller["xi"]) == Parameters().xi
    assert float(controller["robot_weight"]) == pytest.approx(24.525)
    assert values(folder / "resources/plant.ssv")["seed"] == "3"
    settings = {"stored": True, "phi_stored": (3.1, 3.2, 0.1)}
    own = Experiment(settings=settings, controller="tegotae", turn=-0.5)
    folder = build_system(tmp_path / "Own.ssp", own)
    controller = values(folder / "resources/controller.ssv")
    assert controller["stored"] == "true" and controller["turn"] == "-0.5"
    assert [controller[f"phi_stored[{i}]"] for i in (1, 2, 3)] == ["3.1", "3.2", "0.1"]
    # libcosim knows no enumerations: they are numbers, and none is left out of its file
    assert controller["method"] == str(Method.tegotae.value)
    for part in ("controller", "plant"):
        assert osp_values(folder, part) == values(folder / f"resources/{part}.ssv")


def osp_values(folder: Path, part: str) -> dict[str, str]:
    root = etree.parse(folder / "OspSystemStructure.xml").getroot()
    found = root.iterfind(f".//{OSP}Simulator[@name='{part}']//{OSP}InitialValue")
    return {value.get("variable"): value[0].get("value") for value in found}


def plant_starts(experiment: Experiment, **numbers: float) -> dict[str, float]:
    named = {name.replace("_", ".", 1): value for name, value in numbers.items()}
    starts = structure_of(experiment, numbers=named).starts
    return {s.name: s.value for s in starts if s.component == "plant"}


def test_the_plant_starts_as_the_experiment_says() -> None:
    robot, usual = Experiment().description, plant_starts(Experiment())
    assert usual["step"] == 1 / 960 and usual["condition"] == Condition.C1.value
    for part in ("servo", "contact", "sensor"):
        for name, value in vars(getattr(robot, part)).items():
            if name != "component":
                assert usual[f"{part}.{name}"] == value
    ground = Obstacles(slope=0.1, roughness=0.5, seed=7)
    own = Experiment(ground=ground, seed=7, step=1 / 480, conditions="S3")
    changed = {"seed": 7, "roughness": 0.5, "slope": 0.1, "step": 1 / 480, "condition": 7}
    assert plant_starts(own, servo_stiffness=20.0) == usual | changed | {"servo.stiffness": 20.0}
    assert plant_starts(Experiment(ground=Plane(slope=-0.1))) == usual | {"slope": -0.1}


@pytest.mark.parametrize(
    ("conditions", "condition", "payload"),
    [
        ("C4", Condition.C4, 0.0),
        (Conditions(payload=0.5), Condition.C1, 0.5),
        (Conditions(payload=1.25), Condition.C1, 1.25),
        (replace(CONDITIONS["S2"], payload=0.5), Condition.S2, 0.5),
    ],
)
def test_a_payload_comes_on_top_of_a_condition(
    conditions: str | Conditions, condition: Condition, payload: float
) -> None:
    starts = plant_starts(Experiment(conditions=conditions))
    assert (starts["condition"], starts["payload"]) == (condition.value, payload)


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
    ("arguments", "words"),
    [
        (["build-system", "--output", "x.fmu"], "x.fmu does not end in .ssp"),
        (["build-system", "--naming", "cow"], "naming 'cow' is not one of structured"),
        (["build-system", "--gait", "no.json"], "no.json: cannot be read"),
        (["build-system", "--condition", "C9"], "conditions 'C9' are not one of"),
        (["build-system", "--payload", "-1"], "payload is -1.0; allowed:"),
        (["build-system", "--set", "servo.damping=x"], "servo.damping = 'x'; allowed: a number"),
        (["build-system", "--set", "servo.cow=1"], "parameter 'servo.cow' is not one of"),
        (["build-system", "--roughness", "2"], "roughness is 2.0; allowed: 0 ... 1"),
        (["build-plant", "--robot", "cow"], "robot 'cow'"),
        (["build-plant", "--naming", "cow"], "naming 'cow' is not one of"),
        (["build-plant", "--fmi", "1"], "fmi = 1 is not one of 2, 3"),
        (["build-plant", "--platform", "vax"], "platform 'vax' is not one of linux64, "),
    ],
)
def test_bad_use_is_one_line(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as end:
        command_line.main(arguments)
    error = capsys.readouterr().err
    assert end.value.code == 2 and words in error and len(error.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_the_commands_write_what_they_say(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_gait(Gait(("RF", "RH", "LF", "LH"), (3.1, 3.2, 0.1)), Path("gait.json"))
    for words in (
        ["build-plant", "--platform", "host"],
        ["build-plant", "--platform", "host", "--fmi", "3", "--output", "Three.fmu"],
        [
            "build-system",
            "--gait",
            "gait.json",
            "--mi",
            "0.2",
            "--rate",
            "50",
            "--turn",
            "0.3",
            "--roughness",
            "0.5",
            "--slope",
            "3",
            "--seed",
            "4",
            "--payload",
            "0.5",
            "--condition",
            "S2",
            "--set",
            "servo.stiffness=20",
            "--set",
            "xi=0.05",
            "--set",
            "sensor.component=norm",
        ],
    ):
        with pytest.raises(SystemExit) as end:
            command_line.main(words)
        assert end.value.code == 0, capsys.readouterr().err
    assert fmpy.read_model_description("LilibotPlant.fmu").modelName == "LilibotPlant"
    assert fmpy.read_model_description("Three.fmu").fmiVersion == "3.0"
    controller = values(Path("Lilibot/resources/controller.ssv"))
    assert (controller["MI"], controller["stored"], controller["turn"]) == ("0.2", "true", "0.3")
    assert controller["xi"] == "0.05"
    plant = values(Path("Lilibot/resources/plant.ssv"))
    wanted = {"roughness": 0.5, "slope": math.radians(3.0), "seed": 4, "payload": 0.5,
              "condition": 6, "servo.stiffness": 20.0, "sensor.component": 2}  # fmt: skip
    assert {name: float(plant[name]) for name in wanted} == wanted
    assert "<BaseStepSize>0.02" in Path("Lilibot/OspSystemStructure.xml").read_text()
