"""The files of a system: an SSP archive, and a folder for other tools."""

from __future__ import annotations

import importlib.resources
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from apnc import Experiment
from apnc.system.build import build_system
from apnc.system.osp import osp
from apnc.system.structure import structure_of
from apnc_core.enumerations import Method
from apnc_core.interface import Parameters

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


def test_a_folder_used_again_keeps_no_fmu_of_the_older_system(tmp_path: Path) -> None:
    folder = build_system(tmp_path / "X.ssp", Experiment())
    for own in ("Own.fmu", "notes.txt"):
        (folder / "resources" / own).write_text("of the user")
    build_system(tmp_path / "X.ssp", Experiment(robot="hexapod"))
    found = {path.name for path in (folder / "resources").iterdir()}
    system = {"Apnc.fmu", "HexapodPlant.fmu", "controller.ssv", "plant.ssv"}
    assert found == system | {"Own.fmu", "notes.txt"}


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
