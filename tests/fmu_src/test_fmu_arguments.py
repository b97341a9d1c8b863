"""Bad arguments: wrong pointers, references and values give fmi2Error with a message."""

from __future__ import annotations

import ctypes
import math
import random
from typing import Any

import pytest
from fmu_slave import SCALARS
from raw_fmu import ERROR, OK, PROTOTYPES, TS, WARNING, Instance, Library, fmu_in

from apnc_core.schema import Causality, Type

REAL = (ctypes.c_uint * 1)(SCALARS["b1"].value_reference)
ROOM = ctypes.create_string_buffer(8)


@pytest.mark.parametrize("function", PROTOTYPES)
def test_no_component(library: Library, function: str) -> None:
    fmu = Instance(library)
    fmu.free()
    zeros = [0.0 if kind is ctypes.c_double else 0 for kind in PROTOTYPES[function][1:]]
    arguments = [
        None if kind is ctypes.c_void_p else zero
        for kind, zero in zip(PROTOTYPES[function][1:], zeros, strict=True)
    ]
    assert fmu(function, *arguments) == ERROR
    library.calls.fmi2FreeInstance(None)


@pytest.mark.parametrize(
    ("function", "arguments"),
    [
        ("fmi2SetDebugLogging", (1, 2, None)),
        *[(f"fmi2{do}{kind}", (None, 1, ROOM)) for do in ("Get", "Set")
          for kind in ("Real", "Integer", "Boolean", "String")],
        *[(f"fmi2{do}{kind}", (REAL, 1, None)) for do in ("Get", "Set")
          for kind in ("Real", "Integer", "Boolean", "String")],
        ("fmi2GetFMUstate", (None,)),
        ("fmi2SetFMUstate", (None,)),
        ("fmi2SerializedFMUstateSize", (None, ROOM)),
        ("fmi2SerializedFMUstateSize", (ROOM, None)),
        ("fmi2SerializeFMUstate", (None, ROOM, 8)),
        ("fmi2SerializeFMUstate", (ROOM, None, 8)),
        ("fmi2SerializeFMUstate", (ROOM, ROOM, 8)),
        ("fmi2DeSerializeFMUstate", (None, 8, ROOM)),
        ("fmi2DeSerializeFMUstate", (ROOM, 8, None)),
        ("fmi2DeSerializeFMUstate", (ROOM, 0, ROOM)),
    ],
)  # fmt: skip
def test_null_pointers_are_refused_by_name(
    library: Library, function: str, arguments: tuple[Any, ...]
) -> None:
    fmu = fmu_in(library, "stepping")
    assert fmu(function, *arguments) == ERROR
    assert len(fmu.messages) == 1
    fmu.free()


@pytest.mark.parametrize("name", ["Real", "Integer", "Boolean", "String"])
def test_no_values_at_all_need_no_pointers(library: Library, name: str) -> None:
    fmu = fmu_in(library, "stepping")
    assert fmu(f"fmi2Get{name}", None, 0, None) == OK
    assert fmu(f"fmi2Set{name}", None, 0, None) == OK
    fmu.free()


def test_freeing_no_state_is_no_error(library: Library) -> None:
    fmu = fmu_in(library, "stepping")
    assert fmu("fmi2FreeFMUstate", None) == OK
    assert fmu("fmi2FreeFMUstate", ctypes.byref(ctypes.c_void_p())) == OK
    fmu.free()


KNOWN = {s.value_reference: s for s in SCALARS.values()}


@pytest.mark.parametrize("kind", [Type.real, Type.integer, Type.boolean])
def test_every_value_reference_is_known_or_refused_by_number(library: Library, kind: Type) -> None:
    fmu = fmu_in(library, "stepping")
    rng = random.Random(0)
    unknown = [2**32 - 1, 2**31, 2**31 - 1] + [rng.randrange(2**32) for _ in range(2000)]
    for reference in [*range(6000), *unknown]:
        fmu.log.clear()
        status = fmu(f"fmi2Get{kind}", (ctypes.c_uint * 1)(reference), 1, ROOM)
        known = KNOWN.get(reference)
        if known is None:
            assert status == ERROR and str(reference) in fmu.messages[0]
        elif known.variable.type is kind or (
            known.variable.type is Type.enumeration and kind is Type.integer
        ):
            assert status == OK
        else:
            assert status == ERROR and known.name in fmu.messages[0]
    fmu.free()


def test_duplicate_references_the_last_value_counts(library: Library) -> None:
    fmu = fmu_in(library, "stepping")
    b1 = REAL[0]
    assert fmu.set([b1, b1, b1], [0.1, 0.2, 0.3]) == OK
    assert fmu.get([b1, b1]) == [0.3, 0.3]
    fmu.free()


@pytest.mark.parametrize(
    "name", [s.name for s in SCALARS.values() if s.variable.causality is Causality.output]
)
def test_outputs_cannot_be_set(library: Library, name: str) -> None:
    scalar = SCALARS[name]
    kind = str(scalar.variable.type)
    for state in ("instantiated", "initialization", "stepping"):
        fmu = fmu_in(library, state)
        assert fmu.set([scalar.value_reference], [0], kind) == ERROR
        assert name in fmu.messages[0]
        fmu.free()


ODD = [math.nan, math.inf, -math.inf, 5e-324, -5e-324, -0.0, 1.7e308, -1.7e308, 1e-310]


def finite(fmu: Instance, names: tuple[str, ...] | None = None) -> bool:
    references = [
        reference
        for reference, s in KNOWN.items()
        if s.variable.type is Type.real
        and s.variable.causality in (Causality.output, Causality.local)
        and (names is None or s.variable.name in names)
    ]
    return all(map(math.isfinite, fmu.get(references)))


@pytest.mark.parametrize("method", range(1, 5))
@pytest.mark.parametrize("name", ["MI", "turn", "leg[1].grf", "leg[4].grf"])
@pytest.mark.parametrize("value", [*ODD, 1e150])
def test_odd_inputs_never_spoil_the_outputs(
    library: Library, name: str, value: float, method: int
) -> None:
    fmu = fmu_in(library, "initialization")
    assert fmu.set([SCALARS["method"].value_reference], [method], "Integer") == OK
    assert fmu("fmi2ExitInitializationMode") == OK
    # the feedback of a load beyond 1e150 N is too large for a number; the commands never are
    shown = None if value != 1.7e308 else ("theta_hip", "theta_knee", "o1", "o2")
    for n in range(200):
        assert fmu.set([SCALARS[name].value_reference], [value if n < 20 else 0.05]) == OK
        assert fmu.step(n * TS) in (OK, WARNING)
        assert finite(fmu, shown), n
    fmu.free()


@pytest.mark.parametrize("value", ODD)
@pytest.mark.parametrize("tunable", [True, False])
def test_odd_parameters_are_refused_or_in_range(
    library: Library, value: float, tunable: bool
) -> None:
    for reference, scalar in KNOWN.items():
        v = scalar.variable
        if v.causality is not Causality.parameter or v.type is not Type.real:
            continue
        assert v.min is not None and v.max is not None
        inside = v.min <= value <= v.max
        fmu = fmu_in(library, "stepping" if tunable else "initialization")
        status = fmu.set([reference], [value])
        if not tunable:
            assert status == OK
            status = fmu("fmi2ExitInitializationMode")
        elif v.variability == "fixed":
            inside = False
        assert (status == OK) == inside, scalar.name
        assert inside or scalar.name in fmu.messages[0]
        fmu.free()
