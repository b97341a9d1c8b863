"""Builds in which every variable is a Real, for importers that read all of them so."""

from __future__ import annotations

import math
import zipfile
from collections.abc import Iterator
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from fmu_slave import SCALARS
from raw_fmu import ERROR, OK, TS, Instance, Library, fmu_in
from raw_walk import LOADS

from apnc.system.plant_fmu import PlantBuild, plant_fmu
from apnc_core.schema import Type
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions, host_platform

METHOD, RESET = SCALARS["method"].value_reference, SCALARS["reset"].value_reference
STORED, HOLD = SCALARS["stored"].value_reference, SCALARS["kappa_hold"].value_reference


def built(fmi: int) -> Path:
    return cached_fmu(BuildOptions(platforms=(host_platform(),), fmi=fmi, reals=True))


@pytest.fixture(scope="module")
def reals(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Library]:
    folder = tmp_path_factory.mktemp("reals")
    with zipfile.ZipFile(built(2)) as archive:
        archive.extractall(folder)
    return Library.load(folder)


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_description_is_valid_and_shows_nothing_but_reals(fmi: int) -> None:
    assert validate_fmu(str(built(fmi))) == []
    variables = fmpy.read_model_description(str(built(fmi))).modelVariables
    assert {v.type for v in variables} == {"Real" if fmi == 2 else "Float64"}
    items = next(v.description for v in variables if v.name == "method")
    assert items.endswith("1 apnc, 2 apc, 3 tegotae, 4 phase_reset")


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_robot_is_shown_so_too(fmi: int) -> None:
    path = plant_fmu(PlantBuild(fmi=fmi, platforms=(host_platform(),), reals=True))
    assert validate_fmu(str(path)) == []
    kind = "Real" if fmi == 2 else "Float64"
    description = fmpy.read_model_description(str(path))
    assert {v.type for v in description.modelVariables} == {kind}
    # the one Boolean output, which would end the run of such an importer
    fell = fmpy.simulate_fmu(
        str(path), stop_time=0.2, output_interval=TS, start_values={"seed": 3.0}, output=["fell"]
    )["fell"]
    assert set(fell) == {0.0}


def test_names_and_value_references_are_those_of_every_build() -> None:
    variables = fmpy.read_model_description(str(built(2))).modelVariables
    found = {v.name: v.valueReference for v in variables}
    assert found == {s.name: s.value_reference for s in SCALARS.values()}


def test_it_walks_as_the_build_with_all_types(reals: Library, library: Library) -> None:
    one, other = fmu_in(reals, "stepping"), fmu_in(library, "stepping")
    for n in range(300):
        for fmu in (one, other):
            fmu.set(LOADS, [3.0 + n % 7, 9.0, 5.0, -1.0 if n == 50 else 8.0 - n % 5])
        one.set([RESET], [float(n in (100, 101))])
        other.set([RESET], [int(n in (100, 101))], "Boolean")
        assert one.step(n * TS) == other.step(n * TS)
        for s in SCALARS.values():
            kind = {Type.enumeration: "Integer"}.get(s.variable.type, str(s.variable.type))
            assert one.get([s.value_reference]) == other.get([s.value_reference], kind), s.name
    one.free()
    other.free()


def test_the_other_types_are_refused_by_name(reals: Library) -> None:
    fmu = fmu_in(reals, "initialization")
    assert fmu.set([METHOD], [1], "Integer") == ERROR
    assert fmu.messages == ["method is of type Real, not Integer"]
    fmu.free()


@pytest.mark.parametrize(
    ("reference", "value", "taken"),
    [(METHOD, 3.0, 3.0), (HOLD, 7.0, 7.0), (STORED, 1.0, 1.0), (RESET, 2.0, 1.0)],
)
def test_whole_numbers_are_taken(
    reals: Library, reference: int, value: float, taken: float
) -> None:
    fmu = fmu_in(reals, "initialization")
    assert fmu.set([reference], [value]) == OK
    assert fmu.get([reference]) == [taken]
    assert fmu("fmi2ExitInitializationMode") == OK
    fmu.free()


@pytest.mark.parametrize("reference", [METHOD, HOLD, STORED, RESET])
@pytest.mark.parametrize("value", [0.5, math.nan, math.inf, 1e300, -2147483649.0])
def test_what_is_not_a_whole_number_is_refused_and_changes_nothing(
    reals: Library, reference: int, value: float
) -> None:
    fmu = fmu_in(reals, "initialization")
    before = fmu.get([reference])
    assert fmu.set([reference], [value]) == ERROR
    assert "is not a whole number" in fmu.messages[0]
    assert fmu.get([reference]) == before
    fmu.free()


def test_a_number_out_of_range_is_refused_at_the_start(reals: Library) -> None:
    fmu: Instance = fmu_in(reals, "initialization")
    assert fmu.set([METHOD], [5.0]) == OK
    assert fmu("fmi2ExitInitializationMode") == ERROR
    assert "method = 5 is out of range: 1 ... 4" in fmu.messages[0]
    fmu.free()
