"""The user's own start values: the same in the description, the C code and the reference."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu
from lxml import etree

from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_core.presets import preset
from apnc_core.schema import Causality, Type
from apnc_core.variables import scalars
from build_fmu.build import build_key, fmu_bytes
from build_fmu.options import BuildError, BuildOptions, host_platform

PHI = (3.0, 0.1, -3.0)
OWN: dict[str, Any] = {
    "preset": "paper",
    "settings": {"robot_weight": 60, "method": "tegotae", "N": 40, "B_s": 1e-5, "Ts": 0.01},
    "gait": PHI,
}


def built(tmp_path: Path, **choice: Any) -> Path:
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu_bytes(BuildOptions(platforms=(host_platform(),), **choice)))
    return path


def starts_in_c(path: Path) -> dict[str, float]:
    """Parameters as a new instance has them before anything is set."""
    description = fmpy.read_model_description(str(path))
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(path)),
        modelIdentifier="Apnc",
        instanceName="test",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    read = {Type.real: fmu.getReal, Type.boolean: fmu.getBoolean}
    found = {
        s.name: read.get(s.variable.type, fmu.getInteger)([s.value_reference])[0]
        for s in scalars()
        if s.variable.causality is Causality.parameter
    }
    fmu.exitInitializationMode()
    fmu.terminate()
    fmu.freeInstance()
    return found


def as_number(text: str) -> float:
    return {"true": 1.0, "false": 0.0}.get(text) if text in ("true", "false") else float(text)


@pytest.mark.parametrize("enumerations", ["enumeration", "integer"])
def test_xml_and_c_start_alike(enumerations: str, tmp_path: Path) -> None:
    path = built(tmp_path, enumerations=enumerations, **OWN)
    assert validate_fmu(str(path)) == []
    in_xml = {
        v.name: as_number(v.start)
        for v in fmpy.read_model_description(str(path)).modelVariables
        if v.causality == "parameter"
    }
    assert starts_in_c(path) == in_xml
    printed = preset("paper")
    assert in_xml["w11"] == printed.w11 and in_xml["a1"] == printed.a1 == 0.14
    assert in_xml["robot_weight"] == 60.0 and in_xml["method"] == Method.tegotae
    assert tuple(in_xml[f"phi_stored[{k}]"] for k in (1, 2, 3)) == PHI and in_xml["stored"] == 1.0


def test_without_own_defaults_nothing_is_written_beside_the_table(tmp_path: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(fmu_bytes(BuildOptions(platforms=())))) as archive:
        assert b"APNC_DEFAULTS" not in archive.read("sources/apnc_config.h")
        assert b"starts with" not in archive.read("modelDescription.xml")


def test_they_are_named_and_part_of_guid_and_key() -> None:
    builds = [
        BuildOptions(platforms=(), **choice)
        for choice in ({}, OWN, {"enumerations": "integer"}, {"gait": PHI}, {"preset": "paper"})
    ]
    roots = []
    for options in builds:
        with zipfile.ZipFile(io.BytesIO(fmu_bytes(options))) as archive:
            roots.append(etree.fromstring(archive.read("modelDescription.xml")))
    assert len({root.get("guid") for root in roots}) == len(builds)
    assert len({build_key(options) for options in builds}) == len(builds)
    said = roots[1].get("description")
    assert said.endswith(
        "starts with preset paper, B_s = 1e-05, N = 40, Ts = 0.01, method = tegotae, "
        "phi_stored = 3 0.1 -3, robot_weight = 60, stored = true"
    )


def test_fmi_3_starts_with_them(tmp_path: Path) -> None:
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu_bytes(BuildOptions(platforms=(), fmi=3, enumerations="integer", **OWN)))
    assert validate_fmu(str(path)) == []
    found = {v.name: v for v in fmpy.read_model_description(str(path)).modelVariables}
    assert found["phi_stored"].start == "3.0 0.1 -3.0"
    assert (found["method"].type, found["method"].start) == ("Int32", "3")


def test_enumerations_as_integers_take_the_same_calls(tmp_path: Path) -> None:
    """Outputs of tegotae, set by number in both kinds of build."""
    theta = []
    for enumerations in ("enumeration", "integer"):
        result = fmpy.simulate_fmu(
            str(built(tmp_path, enumerations=enumerations)),
            stop_time=2.0,
            start_values={"method": 3, "leg[1].grf": 9.0},
            output=["leg[1].theta_hip", "leg[1].gamma"],
        )
        theta.append(result["leg[1].theta_hip"])
        assert result["leg[1].gamma"][-1] == Parameters().gamma_tegotae
    np.testing.assert_array_equal(*theta)


def test_memory_and_settings_say_the_same() -> None:
    by_gait = BuildOptions(gait=PHI)
    by_settings = BuildOptions(settings={"stored": True, "phi_stored": PHI})
    assert by_gait == by_settings and build_key(by_gait) == build_key(by_settings)


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ({"preset": "cow"}, "preset 'cow' is not one of lilibot, paper"),
        ({"enumerations": "x"}, "enumerations 'x' is not one of enumeration, integer"),
        ({"settings": {"cow": 1}}, "parameter 'cow' is not one of Ts, "),
        ({"settings": {"theta_hip": 1}}, "parameter 'theta_hip' is not one of Ts, "),
        ({"settings": {"xi": 2}}, "xi = 2; allowed: a number from 0 to 1"),
        ({"settings": {"xi": float("nan")}}, "xi = nan; allowed: a number from 0 to 1"),
        ({"settings": {"N": 3.7}}, "N = 3.7; allowed: a whole number"),
        ({"settings": {"method": "cow"}}, "method = 'cow' is not one of apnc, apc"),
        ({"settings": {"stored": 2}}, "stored = 2; allowed: true or false"),
        ({"settings": {"phi_stored": 1.0}}, "phi_stored = 1.0; allowed: a list of numbers"),
        ({"gait": (1.0,)}, "phi_stored has 1 values; 4 legs take 3"),
        (
            {"gait": (1.0, 2.0, 9.0)},
            r"phi_stored = \(1.0, 2.0, 9.0\); allowed: a number from -7 to 7",
        ),
    ],
)
def test_what_does_not_fit_is_one_line(choice: dict[str, Any], message: str) -> None:
    with pytest.raises(BuildError, match=message) as raised:
        BuildOptions(**choice)
    assert "\n" not in str(raised.value)
