"""Order of calls: every function in every state of the FMU; values before the first step."""

from __future__ import annotations

import ctypes
from typing import Any

import pytest
from fmu_slave import SCALARS
from raw_fmu import DISCARD, ERROR, OK, PROTOTYPES, TS, Instance, Library, fmu_in
from raw_walk import LOADS, REAL_OUTPUTS

from apnc_core.interface import Parameters

STATES = ("instantiated", "initialization", "stepping", "terminated")
REAL = (ctypes.c_uint * 1)(SCALARS["b1"].value_reference)
INTEGER = (ctypes.c_uint * 1)(SCALARS["kappa_hold"].value_reference)
BOOLEAN = (ctypes.c_uint * 1)(SCALARS["reset"].value_reference)
FINE = (ctypes.c_double * 1)(0.1)
WHOLE = (ctypes.c_int * 1)(1)
ROOM = ctypes.create_string_buffer(8)
# Arguments that are right, and the states the standard allows the call in (FMI 2.0, 4.2.4).
ANY = set(STATES)
READ = {"initialization", "stepping", "terminated"}
WRITE = {"instantiated", "initialization", "stepping"}
CALLS: dict[str, tuple[tuple[Any, ...], set[str]]] = {
    "fmi2SetDebugLogging": ((1, 0, None), ANY),
    "fmi2SetupExperiment": ((0, 0.0, 0.0, 0, 0.0), {"instantiated"}),
    "fmi2EnterInitializationMode": ((), {"instantiated"}),
    "fmi2ExitInitializationMode": ((), {"initialization"}),
    "fmi2Terminate": ((), {"stepping"}),
    "fmi2Reset": ((), ANY),
    "fmi2GetReal": ((REAL, 1, ROOM), READ),
    "fmi2GetInteger": ((INTEGER, 1, ROOM), READ),
    "fmi2GetBoolean": ((BOOLEAN, 1, ROOM), READ),
    "fmi2GetString": ((None, 0, None), READ),
    "fmi2SetReal": ((REAL, 1, FINE), WRITE),
    "fmi2SetInteger": ((INTEGER, 1, WHOLE), WRITE),
    "fmi2SetBoolean": ((BOOLEAN, 1, WHOLE), WRITE),
    "fmi2SetString": ((None, 0, None), WRITE),
    "fmi2DoStep": ((0.0, TS, 1), {"stepping"}),
    "fmi2CancelStep": ((), set()),  # steps are never pending
    "fmi2GetDirectionalDerivative": ((None, 0, None, 0, None, None), set()),  # not offered
    "fmi2SetRealInputDerivatives": ((REAL, 1, WHOLE, FINE), set()),  # not offered
    "fmi2GetRealOutputDerivatives": ((REAL, 1, WHOLE, ROOM), set()),  # not offered
}
# What has an answer though no step is ever pending; the others are discarded.
QUESTIONS = {
    "fmi2GetStatus": {},
    "fmi2GetRealStatus": {2: OK},  # fmi2LastSuccessfulTime
    "fmi2GetIntegerStatus": {},
    "fmi2GetBooleanStatus": {3: OK},  # fmi2Terminated
    "fmi2GetStringStatus": {},
}
STATE_CALLS = {name for name in PROTOTYPES if "FMUstate" in name}


def test_the_tables_cover_every_function() -> None:
    assert set(CALLS) | set(QUESTIONS) | STATE_CALLS == set(PROTOTYPES)
    # the rest of the 34: version, platform, instantiate, free
    assert len(PROTOTYPES) == 34 - 4


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("function", CALLS)
def test_calls_are_taken_where_the_standard_allows_them_only(
    library: Library, function: str, state: str
) -> None:
    fmu = fmu_in(library, state)
    arguments, allowed = CALLS[function]
    status = fmu(function, *arguments)
    if state in allowed:
        assert status == OK and fmu.messages == []
    else:
        assert status == ERROR
        assert len(fmu.messages) == 1 and fmu.messages[0].startswith(function)
        # and it goes on as if nothing had happened
        assert fmu("fmi2Reset") == OK
        fmu.start()
        assert fmu.step(0.0) == OK
    fmu.free()


@pytest.mark.parametrize("kind", range(-1, 6))
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("function", QUESTIONS)
def test_status_questions(library: Library, function: str, state: str, kind: int) -> None:
    fmu = fmu_in(library, state)
    status = fmu(function, kind, ROOM)
    if state in ("stepping", "terminated"):
        assert status == QUESTIONS[function].get(kind, DISCARD)
        assert fmu(function, kind, None) == ERROR
    else:
        assert status == ERROR
    assert all(message.startswith(function) for message in fmu.messages)
    fmu.free()


B1 = [SCALARS["b1"].value_reference]
HIP = [SCALARS["leg[1].theta_hip"].value_reference]
SWING = Parameters().a1 * Parameters().o1_start


def test_parameters_before_setup_and_again_in_initialization_mode(library: Library) -> None:
    fmu = Instance(library)
    assert fmu.set(B1, [0.2]) == OK
    assert fmu("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0) == OK
    assert fmu.set(B1, [0.25]) == OK
    assert fmu("fmi2EnterInitializationMode") == OK
    assert fmu.get(HIP) == pytest.approx([0.25 + SWING])
    assert fmu.set(B1, [0.3]) == OK
    assert fmu.get(HIP) == pytest.approx([0.3 + SWING])
    assert fmu("fmi2ExitInitializationMode") == OK
    assert fmu.get(HIP) == pytest.approx([0.3 + SWING])
    fmu.free()


def test_inputs_only_after_initialization_or_already_in_it(
    library: Library, expected: list[list[float]]
) -> None:
    fmu = Instance(library)
    assert fmu("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0) == OK
    assert fmu("fmi2EnterInitializationMode") == OK
    assert fmu.set(LOADS, [3.0, 9.0, 5.0, 8.0]) == OK
    assert fmu("fmi2ExitInitializationMode") == OK
    # the first step uses what was set in initialization mode
    assert fmu.step(0.0) == OK
    assert fmu.get(REAL_OUTPUTS) == expected[0]
    fmu.free()
