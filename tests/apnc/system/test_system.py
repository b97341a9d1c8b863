"""The files of a system: what they say about the two FMUs, and what they leave out."""

from __future__ import annotations

import importlib.resources
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from apnc import Experiment
from apnc.cli import main as command_line
from apnc.loop.gait import Gait, write_gait
from apnc.system.build import build_system
from apnc.system.structure import structure_of
from apnc_core.interface import Parameters

SSP = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"
OSP = "{http://opensimulationplatform.com/MSMI/OSPSystemStructure}"


@pytest.fixture(scope="module", params=["structured", "flat"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp(request.param) / "Lilibot.ssp"
    return build_system(output, Experiment(mi=0.15, seed=3), request.param)


def test_the_archive_is_the_folder_without_the_file_of_osp(folder: Path) -> None:
    with zipfile.ZipFile(folder.with_suffix(".ssp")) as archive:
        names = set(archive.namelist())
        assert names == {
            "SystemStructure.ssd",
            *(f"resources/{n}" for n in ("Apnc.fmu", "LilibotPlant.fmu")),
            *(f"resources/{n}" for n in ("controller.ssv", "plant.ssv")),
        }
        for name in names:
            assert archive.read(name) == (folder / name).read_bytes()
    assert (folder / "OspSystemStructure.xml").is_file()


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
    # FMPy writes 0 to the others, and MI = 0 is a reset
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
    assert abs(float(step.text) - 1 / 60) < 1e-9 and len(step.text) == len("0.016666667")


def values(file: Path) -> dict[str, str]:
    root = etree.parse(file).getroot()
    return {p.get("name"): p[0].get("value") for p in root.iter(f"{SSV}Parameter")}


def test_the_parameter_sets_hold_the_preset(folder: Path, tmp_path: Path) -> None:
    controller = values(folder / "resources/controller.ssv")
    assert controller["MI"] == "0.15" and float(controller["xi"]) == Parameters().xi
    assert float(controller["robot_weight"]) == pytest.approx(24.525)
    assert values(folder / "resources/plant.ssv")["seed"] == "3"
    settings = {"stored": True, "phi_stored": (3.1, 3.2, 0.1)}
    own = Experiment(settings=settings, method="tegotae", conditions="S3")
    folder = build_system(tmp_path / "Own.ssp", own)
    controller = values(folder / "resources/controller.ssv")
    assert controller["stored"] == "true" and controller["method"] == "tegotae"
    assert [controller[f"phi_stored[{i}]"] for i in (1, 2, 3)] == ["3.1", "3.2", "0.1"]
    assert values(folder / "resources/plant.ssv")["condition"] == "7"  # every tool takes numbers
    assert 'variable="method"' not in (folder / "OspSystemStructure.xml").read_text()


@pytest.mark.parametrize(
    ("experiment", "words"),
    [
        (Experiment(mi=((0.0, 0.1), (5.0, 0.2))), "mi = "),
        (Experiment(turn=0.5), "turn = 0.5"),
        (Experiment(conditions=((0.0, "C1"), (5.0, "S3"))), "conditions = "),
        (Experiment(robot=Experiment().description), "robot = "),
    ],
)
def test_what_a_system_cannot_hold_is_refused(experiment: Experiment, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        structure_of(experiment)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["build-system", "--output", "x.fmu"], "x.fmu does not end in .ssp"),
        (["build-system", "--naming", "cow"], "naming 'cow' is not one of structured"),
        (["build-system", "--memory", "no.json"], "no.json cannot be read"),
        (["build-system", "--condition", "C9"], "conditions 'C9' are not one of"),
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
        ["build-system", "--memory", "gait.json", "--mi", "0.2", "--rate", "50"],
    ):
        with pytest.raises(SystemExit) as end:
            command_line.main(words)
        assert end.value.code == 0, capsys.readouterr().err
    assert fmpy.read_model_description("LilibotPlant.fmu").modelName == "LilibotPlant"
    assert fmpy.read_model_description("Three.fmu").fmiVersion == "3.0"
    controller = values(Path("Lilibot/resources/controller.ssv"))
    assert (controller["MI"], controller["stored"]) == ("0.2", "true")
    assert "<BaseStepSize>0.02" in Path("Lilibot/OspSystemStructure.xml").read_text()
