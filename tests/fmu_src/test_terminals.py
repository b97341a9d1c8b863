"""terminalsAndIcons.xml of the FMI 3.0 builds. No importer here reads it, no checker opens it."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from apnc.system.plant_fmu import PlantBuild, plant_fmu
from build_fmu.build import fmu_bytes
from build_fmu.icon import SIZE
from build_fmu.options import BuildOptions
from build_fmu.terminals import ICON, PATH

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
FLAT, ARRAYS = {"naming": "flat"}, {"naming": "structured"}

Terminals = dict[str, dict[str, tuple[str, str]]]
"""Name of a variable and its causality, by terminal and member."""


def files_of(content: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def controller(**choices: object) -> dict[str, bytes]:
    return files_of(fmu_bytes(BuildOptions(platforms=(), fmi=3, **choices)))  # type: ignore[arg-type]


def plant(robot: str, naming: str) -> dict[str, bytes]:
    build = PlantBuild(robot, naming, fmi=3, platforms=())
    return files_of(plant_fmu(build).read_bytes())


def terminals_of(files: dict[str, bytes]) -> Terminals:
    root = etree.fromstring(files[PATH])
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(root)
    variables = etree.fromstring(files["modelDescription.xml"]).find("ModelVariables")
    assert variables is not None
    causality = {v.get("name"): v.get("causality") for v in variables}
    found: Terminals = {}
    for terminal in root.iterfind("Terminals/Terminal"):
        assert terminal.get("matchingRule") == "plug"
        members = terminal.findall("TerminalMemberVariable")
        assert {member.get("variableKind") for member in members} == {"signal"}
        names = {str(m.get("memberName")): str(m.get("variableName")) for m in members}
        assert len(names) == len(members) and terminal.get("name") not in found
        found[str(terminal.get("name"))] = {
            member: (name, str(causality[name])) for member, name in names.items()
        }
    return found


@pytest.mark.parametrize("legs", [4, 6])
def test_every_leg_of_the_controller_is_a_terminal(legs: int) -> None:
    assert terminals_of(controller(legs=legs, **FLAT)) == {
        f"leg{leg}": {
            "grf": (f"leg{leg}_grf", "input"),
            "theta_hip": (f"leg{leg}_theta_hip", "output"),
            "theta_knee": (f"leg{leg}_theta_knee", "output"),
        }
        for leg in range(1, legs + 1)
    }


def test_arrays_have_one_terminal_for_all_legs() -> None:
    assert terminals_of(controller(**ARRAYS)) == {
        "legs": {
            "grf": ("grf", "input"),
            "theta_hip": ("theta_hip", "output"),
            "theta_knee": ("theta_knee", "output"),
        }
    }


@pytest.mark.parametrize("choice", [FLAT, ARRAYS], ids=["flat", "arrays"])
@pytest.mark.parametrize(("robot", "legs"), [("lilibot", 4), ("hexapod", 6)])
def test_terminals_of_controller_and_robot_fit_together(
    robot: str, legs: int, choice: dict[str, str]
) -> None:
    ours = terminals_of(controller(legs=legs, **choice))
    theirs = terminals_of(plant(robot, **choice))
    assert ours.keys() == theirs.keys()
    for name, members in ours.items():
        assert members.keys() == theirs[name].keys()
        for member, (_, causality) in members.items():
            assert {causality, theirs[name][member][1]} == {"input", "output"}


def test_the_icon_lies_beside_it_and_is_placed() -> None:
    files = controller()
    assert files[ICON].startswith(b"\x89PNG") and SIZE == 256
    root = etree.fromstring(files[PATH])
    system = root.find("GraphicalRepresentation/CoordinateSystem")
    icon = root.find("GraphicalRepresentation/Icon")
    assert system is not None and icon is not None
    corners = ("x1", "y1", "x2", "y2")
    assert [icon.get(c) for c in corners] == [system.get(c) for c in corners]


def test_fmi2_has_no_such_file() -> None:
    assert PATH not in files_of(fmu_bytes(BuildOptions(platforms=())))
