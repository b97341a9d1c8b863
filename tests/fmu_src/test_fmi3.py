"""The FMI 3.0 build: valid, the same controller as the FMI 2.0 build, arrays, refusals."""

from __future__ import annotations

import io
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy import fmi3
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree
from parity import random_loads

from apnc.loop.fmu_controller import FmuController
from apnc_core.schema import VR_TIME, Causality, Type
from apnc_core.variable_numbers import VARIABLE_NUMBERS
from apnc_core.variables import TABLE, scalars, variable_named
from build_fmu.build import cached_fmu, fmu_bytes, host_fmu
from build_fmu.options import BuildOptions, host_platform

TS = 1 / 60
REFERENCE = {name: 100 * number for name, number in VARIABLE_NUMBERS.items()}


@contextmanager
def slave3(legs: int, token: str | None = None, path: Path | None = None) -> Iterator[Any]:
    path = path or host_fmu(legs, fmi=3)
    description = fmpy.read_model_description(str(path))
    folder = tempfile.mkdtemp(prefix="apnc-test-")
    fmpy.extract(str(path), unzipdir=folder)
    try:
        fmu = fmi3.FMU3Slave(
            guid=token or description.instantiationToken,
            unzipDirectory=folder,
            modelIdentifier="Apnc",
            instanceName="test",
        )
        fmu.messages = []
        fmu.instantiate(
            loggingOn=True,
            logMessage=fmi3.fmi3LogMessageCallback(
                lambda env, status, kind, text: fmu.messages.append(text.decode())
            ),
        )
        yield fmu
        fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def start(fmu: Any) -> None:
    fmu.enterInitializationMode(startTime=0.0)
    fmu.exitInitializationMode()


@pytest.mark.parametrize("naming", ["structured", "flat"])
@pytest.mark.parametrize("legs", [4, 6, 8])
def test_valid_by_fmpy_and_by_the_schema(legs: int, naming: str, tmp_path: Path) -> None:
    fmu = fmu_bytes(BuildOptions(legs=legs, naming=naming, platforms=(), fmi=3))
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu)
    assert validate_fmu(str(path)) == []
    schemas = Path(fmpy.__file__).parent / "schema" / "fmi3"
    for name, schema in (
        ("modelDescription.xml", "fmi3ModelDescription.xsd"),
        ("sources/buildDescription.xml", "fmi3BuildDescription.xsd"),
    ):
        with zipfile.ZipFile(io.BytesIO(fmu)) as archive:
            root = etree.fromstring(archive.read(name))
        etree.XMLSchema(etree.parse(str(schemas / schema))).assertValid(root)


@pytest.mark.parametrize("legs", [4, 6, 8])
def test_gives_what_the_fmi2_build_gives(legs: int) -> None:
    loads = random_loads(np.random.default_rng(3), 600, legs, 24.525)
    reals = [
        v for v in TABLE if v.causality in (Causality.output, Causality.local)
        and v.type is Type.real
    ]  # fmt: skip
    with slave3(legs) as three, FmuController(host_fmu(legs)) as two:
        start(three)
        for n in range(600):
            three.setFloat64([REFERENCE["grf"]], loads[n].tolist())
            three.setFloat64([REFERENCE["MI"], REFERENCE["turn"]], [0.15, 0.2])
            three.doStep(n * TS, TS)
            two.step(n * TS, TS, loads[n], 0.15, 0.2, False)
            expected = two.sample()
            count = sum(v.count(legs) for v in reals)
            values = three.getFloat64([REFERENCE[v.name] for v in reals], nValues=count)
            assert values == np.concatenate([expected[v.name].ravel() for v in reals]).tolist()
        assert three.getInt32([REFERENCE["tick"]]) == [600]
        assert three.getFloat64([VR_TIME]) == pytest.approx([10.0])
        assert three.getBoolean([REFERENCE["fault"]], nValues=legs) == [False] * legs


def test_stored_gait_enumeration_and_boolean_can_be_set() -> None:
    with slave3(4) as fmu:
        fmu.enterInitializationMode(startTime=0.0)
        fmu.setInt64([REFERENCE["method"]], [1])
        fmu.setBoolean([REFERENCE["stored"]], [True])
        fmu.setFloat64([REFERENCE["phi_stored"]], [3.0, 3.2, 0.1])
        fmu.exitInitializationMode()
        assert fmu.getFloat64([REFERENCE["phi_memory"]], nValues=3) == [3.0, 3.2, 0.1]
        assert fmu.getFloat64([REFERENCE["kappa"]]) == [1.0]


def test_start_values_can_be_read_before_initialization() -> None:
    with slave3(4) as fmu:
        for v in TABLE:
            get = {
                Type.real: fmu.getFloat64,
                Type.integer: fmu.getInt32,
                Type.boolean: fmu.getBoolean,
                Type.enumeration: fmu.getInt64,
            }[v.type]
            if v.start is not None:
                assert get([REFERENCE[v.name]], nValues=v.count(4)) == [v.start] * v.count(4)
                continue
            with pytest.raises(FMICallException):
                get([REFERENCE[v.name]], nValues=v.count(4))
            assert "no value before initialization" in fmu.messages[-1]
        fmu.setFloat64([REFERENCE["xi"]], [0.5])
        assert fmu.getFloat64([REFERENCE["xi"]]) == [0.5]
        start(fmu)
        assert (
            fmu.getFloat64([REFERENCE["o1"]], nValues=4) == [variable_named("o1_start").start] * 4
        )


@pytest.mark.parametrize(("over", "fine"), [(0.49, True), (0.51, False)])
def test_a_step_beyond_the_stop_time_is_an_error_from_half_a_tick_on(
    over: float, fine: bool
) -> None:
    with slave3(4) as fmu:
        fmu.enterInitializationMode(startTime=0.0, stopTime=TS)
        fmu.exitInitializationMode()
        if fine:
            fmu.doStep(0.0, (1.0 + over) * TS)
            return
        with pytest.raises(FMICallException):
            fmu.doStep(0.0, (1.0 + over) * TS)
        assert "beyond the stop time" in fmu.messages[-1]


def test_saved_state_continues_bit_for_bit() -> None:
    with slave3(4) as fmu:
        start(fmu)

        def go_on() -> list[float]:
            seen: list[float] = []
            for n in range(50, 100):
                fmu.setFloat64([REFERENCE["grf"]], [n % 7, n % 5, n % 3, n % 11])
                fmu.doStep(n * TS, TS)
                seen += fmu.getFloat64([REFERENCE["o1"], REFERENCE["gamma"]], nValues=8)
            return seen

        fmu.doStep(0.0, 50 * TS)
        state = fmu.getFMUState()
        blob = fmu.serializeFMUState(state)
        first = go_on()
        fmu.setFMUState(state)
        assert go_on() == first
        fmu.setFMUState(fmu.deserializeFMUState(blob))
        assert go_on() == first
        fmu.freeFMUState(state)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda f: f.setFloat64([REFERENCE["grf"]], [1.0, 2.0]), "too few values"),
        (lambda f: f.setFloat64([REFERENCE["MI"]], [1.0, 2.0]), "too many values"),
        (lambda f: f.setFloat64([REFERENCE["MI"] + 1], [1.0]), "no variable of this type"),
        (lambda f: f.setFloat64([REFERENCE["method"]], [1.0]), "no variable of this type"),
        (lambda f: f.setFloat64([VR_TIME], [1.0]), "no variable"),
        (lambda f: f.setInt64([REFERENCE["method"]], [2**40]), "method = "),
        (lambda f: f.setFloat64([REFERENCE["o1"]], [0.0] * 4), "output"),
        (lambda f: f.setFloat64([REFERENCE["Ts"]], [0.01]), "fixed"),
        (lambda f: f.getFloat32([REFERENCE["MI"]]), "not offered"),
        (lambda f: f.enterEventMode(), "not offered"),
        (lambda f: f.enterConfigurationMode(), "not offered"),
        (lambda f: f.enterInitializationMode(), "not allowed"),
        (lambda f: f.doStep(5.0, TS), "step starts at 5 s"),
    ],
)
def test_wrong_calls_are_refused_with_a_message(call: Any, words: str) -> None:
    with slave3(4) as fmu:
        start(fmu)
        with pytest.raises(FMICallException):
            call(fmu)
        assert words in fmu.messages[-1]
        fmu.doStep(0.0, TS)


def test_wrong_token_is_refused() -> None:
    with pytest.raises(Exception, match="instantiate"), slave3(4, token="{wrong}"):
        pass


def test_value_references_are_those_of_fmi2() -> None:
    of_first_entries = {s.variable.name: s.value_reference for s in scalars() if s.element == 0}
    assert of_first_entries == REFERENCE


@pytest.fixture(scope="module")
def flat() -> Path:
    return cached_fmu(BuildOptions(naming="flat", fmi=3, platforms=(host_platform(),)))


def test_flat_names_make_every_entry_a_scalar(flat: Path) -> None:
    variables = fmpy.read_model_description(str(flat)).modelVariables
    found = {v.name: v.valueReference for v in variables if v.name != "time"}
    assert found == {s.name: s.value_reference for s in scalars(4, "flat")}
    assert all(v.dimensions == [] for v in variables)


def test_the_start_of_a_scalar_depends_on_its_own_parameters(flat: Path) -> None:
    with zipfile.ZipFile(flat) as archive:
        root = etree.fromstring(archive.read("modelDescription.xml"))
    depends = {
        int(unknown.get("valueReference", "")): unknown.get("dependencies")
        for unknown in root.iterfind("ModelStructure/InitialUnknown")
    }
    stored, phi = REFERENCE["stored"], REFERENCE["phi_stored"]
    for k in range(3):
        assert depends[REFERENCE["phi_memory"] + k] == f"{stored} {phi + k}"
    outputs = [s for s in scalars(4, "flat") if s.variable.causality is Causality.output]
    assert depends.keys() == {s.value_reference for s in outputs}


def test_scalars_have_the_values_of_the_arrays(flat: Path) -> None:
    legs = [REFERENCE["grf"] + k for k in range(4)]
    shown = [v for v in TABLE if v.causality is Causality.output and v.type is Type.real]
    with slave3(4) as arrays, slave3(4, path=flat) as single:
        for fmu in (arrays, single):
            fmu.enterInitializationMode(startTime=0.0)
        arrays.setFloat64([REFERENCE["phi_stored"]], [3.0, 3.2, 0.1])
        single.setFloat64([REFERENCE["phi_stored"] + k for k in (2, 0, 1)], [0.1, 3.0, 3.2])
        for fmu in (arrays, single):
            fmu.setBoolean([REFERENCE["stored"]], [True])
            fmu.exitInitializationMode()
        for n in range(100):
            loads = [3.0 + n % 7, 9.0, 5.0, 8.0 - n % 5]
            arrays.setFloat64([REFERENCE["grf"]], loads)
            single.setFloat64(legs, loads)
            for fmu in (arrays, single):
                fmu.doStep(n * TS, TS)
            for v in shown:
                together = arrays.getFloat64([REFERENCE[v.name]], nValues=v.count(4))
                one_by_one = [
                    value
                    for k in range(v.count(4))
                    for value in single.getFloat64([REFERENCE[v.name] + k])
                ]
                assert together == one_by_one
        assert single.getBoolean([REFERENCE["fault"] + 3]) == [False]


def test_references_beyond_the_legs_are_refused_with_flat_names(flat: Path) -> None:
    with slave3(4, path=flat) as fmu:
        start(fmu)
        for reference in (
            REFERENCE["grf"] + 4,
            REFERENCE["phi"] + 3,
            REFERENCE["MI"] + 1,
            99_00_00,
        ):
            with pytest.raises(FMICallException):
                fmu.getFloat64([reference])
            assert str(reference) in fmu.messages[-1]
