"""SSV files: valid by the standard, read back, and read by another's reader."""

from __future__ import annotations

from pathlib import Path

import fmpy.ssp
import pytest
from fmpy.ssp.ssd import read_ssv as read_by_fmpy
from lxml import etree

from apnc_core.enumerations import Method
from build_fmu.options import BuildError
from build_fmu.ssv import read_ssv, write_ssv

SETTINGS = {
    "robot_weight": 60.0,
    "method": Method.tegotae,
    "N": 40,
    "phi_frozen": False,
    "phi_stored": (3.0, 0.1, -3.0),
    "B_s": 1e-05,
}


@pytest.mark.parametrize("naming", ["structured", "flat"])
def test_what_is_written_is_read(naming: str, tmp_path: Path) -> None:
    write_ssv(SETTINGS, tmp_path / "a.ssv", naming)
    assert read_ssv(tmp_path / "a.ssv") == SETTINGS


def test_follows_the_schema_of_the_standard(tmp_path: Path) -> None:
    write_ssv(SETTINGS, tmp_path / "a.ssv")
    schema = Path(fmpy.ssp.__file__).parent / "schema" / "SystemStructureParameterValues.xsd"
    etree.XMLSchema(etree.parse(str(schema))).assertValid(etree.parse(str(tmp_path / "a.ssv")))


def test_fmpy_reads_the_same(tmp_path: Path) -> None:
    write_ssv(SETTINGS, tmp_path / "a.ssv")
    read = {p.name: (p.type, p.value) for p in read_by_fmpy(str(tmp_path / "a.ssv")).parameters}
    assert read == {
        "robot_weight": ("Real", "60.0"),
        "method": ("Enumeration", "tegotae"),
        "N": ("Integer", "40"),
        "phi_frozen": ("Boolean", "false"),
        "phi_stored[1]": ("Real", "3.0"),
        "phi_stored[2]": ("Real", "0.1"),
        "phi_stored[3]": ("Real", "-3.0"),
        "B_s": ("Real", "1e-05"),
    }


def ssv(parameters: str) -> str:
    space = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
    return (
        f'<ParameterSet xmlns="{space}" version="1.0" name="by hand"><Parameters>{parameters}'
        "</Parameters></ParameterSet>"
    )


def test_a_file_of_another_tool_is_read(tmp_path: Path) -> None:
    path = tmp_path / "a.ssv"
    path.write_text(
        ssv(
            '<Parameter name="method"><Integer value="3"/></Parameter>'
            '<Parameter name="xi"><Real value="0.03" unit="1"/></Parameter>'
            '<Parameter name="stored"><Boolean value="1"/></Parameter>'
        )
    )
    assert read_ssv(path) == {"method": Method.tegotae, "xi": 0.03, "stored": True}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("no xml", "a.ssv is not an SSV file"),
        ("<a/>", "its root is a"),
        (ssv('<Parameter name="cow"><Real value="1"/></Parameter>'), "parameter 'cow' is not one"),
        (
            ssv('<Parameter name="xi"><Real value="2"/></Parameter>'),
            "xi = 2.0; allowed: a number from 0 to 1",
        ),
        (ssv('<Parameter name="xi"><Real value="x"/></Parameter>'), "xi = 'x' is not a number"),
        (ssv('<Parameter name="xi"><Real value="0" unit="deg"/></Parameter>'), "unit 'deg' of xi"),
        (ssv('<Parameter name="xi"/>'), "xi has no number"),
        (ssv('<Parameter name="N"><Real value="3.7"/></Parameter>'), "N = 3.7; allowed: a whole"),
        (ssv('<Parameter name="method"><Enumeration value="x"/></Parameter>'), "method = 'x' is"),
        (ssv('<Parameter name="phi_stored[2]"><Real value="1"/></Parameter>'), "are missing"),
    ],
)
def test_an_unusable_file_is_one_line(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "a.ssv"
    path.write_text(text)
    with pytest.raises(BuildError, match=message) as raised:
        read_ssv(path)
    assert "\n" not in str(raised.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"none\.ssv cannot be read"):
        read_ssv(tmp_path / "none.ssv")
