"""The FMU file: valid, complete, reproducible, and what the build says to bad choices."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from apnc_core.schema import Causality
from apnc_core.variables import scalars
from build_fmu import build
from build_fmu.build import cached_fmu, fmu_bytes
from build_fmu.cache import cache_folder
from build_fmu.options import BuildError, BuildOptions, host_platform

SOURCES_ONLY = BuildOptions(platforms=())
ALWAYS = [(4, "structured"), (6, "flat")]
"""Legs and naming that the default run validates."""


ZIG_CACHE = str(cache_folder() / "zig")  # of the session: the compiler's run time is not made anew


def description(fmu: bytes) -> etree._Element:
    with zipfile.ZipFile(io.BytesIO(fmu)) as archive:
        return etree.fromstring(archive.read("modelDescription.xml"))


FORMS = [
    pytest.param(legs, naming, marks=[] if (legs, naming) in ALWAYS else [pytest.mark.thorough])
    for legs in (2, 4, 6, 8)
    for naming in ("structured", "flat")
]


@pytest.mark.parametrize(("legs", "naming"), FORMS)
def test_fmpy_finds_no_problem(legs: int, naming: str, tmp_path: Path) -> None:
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu_bytes(BuildOptions(legs, naming, ())))
    assert validate_fmu(str(path)) == []


def test_model_description_follows_the_schema_of_the_standard(tmp_path: Path) -> None:
    folder = Path(fmpy.__file__).parent / "schema" / "fmi2"
    schema = etree.XMLSchema(etree.parse(str(folder / "fmi2ModelDescription.xsd")))
    schema.assertValid(description(fmu_bytes(SOURCES_ONLY)))


def test_same_sources_give_the_same_bytes(tmp_path: Path) -> None:
    options = BuildOptions(platforms=(host_platform(),))
    assert fmu_bytes(options) == fmu_bytes(options)


def test_guid_changes_with_the_sources() -> None:
    guids = {
        description(fmu_bytes(BuildOptions(legs, "structured", ()))).get("guid") for legs in (4, 6)
    }
    assert len(guids) == 2


def test_archive_has_no_folder_above_the_description() -> None:
    with zipfile.ZipFile(io.BytesIO(fmu_bytes(SOURCES_ONLY))) as archive:
        names = archive.namelist()
    assert names[0] == "modelDescription.xml"
    assert not any(name.startswith(("./", "/")) for name in names)


def test_model_structure_lists_every_output_without_feedthrough() -> None:
    root = description(fmu_bytes(SOURCES_ONLY))
    outputs = [
        str(i + 1) for i, s in enumerate(scalars()) if s.variable.causality is Causality.output
    ]
    listed = root.findall("ModelStructure/Outputs/Unknown")
    assert [u.get("index") for u in listed] == outputs
    assert all(u.get("dependencies") == "" for u in listed)
    initial = root.findall("ModelStructure/InitialUnknowns/Unknown")
    assert [u.get("index") for u in initial] == outputs


def test_every_declared_unit_and_type_exists() -> None:
    root = description(fmu_bytes(SOURCES_ONLY))
    units = {u.get("name") for u in root.findall("UnitDefinitions/Unit")}
    types = {t.get("name") for t in root.findall("TypeDefinitions/SimpleType")}
    for typed in root.findall("ModelVariables/ScalarVariable/*"):
        assert typed.get("unit") is None or typed.get("unit") in units
        assert typed.get("declaredType") is None or typed.get("declaredType") in types


def test_types_of_fmi_3_have_no_description() -> None:
    """FMPy 0.3.23 and older refuse a file that has one."""
    root = description(fmu_bytes(BuildOptions(platforms=(), fmi=3)))
    types = root.findall("TypeDefinitions/*")
    assert len(types) == 9
    assert [t.get("name") for t in types if t.get("description")] == []


def test_shipped_sources_compile_on_their_own(tmp_path: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(fmu_bytes(SOURCES_ONLY))) as archive:
        archive.extractall(tmp_path)
    folder = tmp_path / "sources"
    compiler = [sys.executable, "-m", "ziglang", "cc"]
    command = [*compiler, "-shared", "-fPIC", "-o", "x.so", *map(str, folder.glob("*.c")), "-lm"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_cache_is_used_and_can_be_moved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("APNC_CACHE", str(tmp_path))
    monkeypatch.setenv("ZIG_GLOBAL_CACHE_DIR", os.environ.get("ZIG_GLOBAL_CACHE_DIR") or ZIG_CACHE)
    monkeypatch.setattr(build, "READY", tmp_path / "none")
    compiled: list[str] = []
    options = BuildOptions(platforms=(host_platform(),))
    first = cached_fmu(options, compiled.append)
    assert first.is_relative_to(tmp_path)
    assert cached_fmu(options, compiled.append) == first
    assert compiled == [host_platform()]


def test_a_failing_compiler_is_quoted() -> None:
    options = BuildOptions(platforms=(host_platform(),))
    with pytest.raises(BuildError, match="no_such_type"):
        fmu_bytes(options, files={"controller.c": b"no_such_type x;"})


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ({"legs": 1}, r"legs = 1 is not in 2 \.\.\. 64"),
        ({"legs": 65}, r"legs = 65 is not in 2 \.\.\. 64"),
        ({"naming": "odd"}, "naming 'odd' is not one of structured, flat"),
        ({"platforms": ("vax",)}, "platform 'vax' is not one of linux64, "),
    ],
)
def test_bad_choices_are_named(choice: dict[str, object], message: str) -> None:
    with pytest.raises(BuildError, match=message):
        BuildOptions(**choice)  # type: ignore[arg-type]  # wrong on purpose
