"""Instantiation of the FMU: arguments that importers pass, and the memory of an instance."""

from __future__ import annotations

import ctypes
from typing import Any

import pytest
from raw_fmu import ERROR, OK, TS, Instance, Library, Memory
from raw_walk import walk


def test_version_and_platform_read_exactly_so(library: Library) -> None:
    assert library.calls.fmi2GetVersion() == b"2.0"
    assert library.calls.fmi2GetTypesPlatform() == b"default"


@pytest.mark.parametrize(
    "resources",
    [
        None,
        b"",
        b"file:///c:/fmus/Apnc/resources",
        b"file:////share/Apnc/resources",
        b"file:/Apnc/resources/",
        b"file:///Apnc",
        b"/Apnc/resources",
        b"file:///a%20b/\xc3\xa4/resources",
        b"x" * 100_000,
    ],
    ids=["none", "empty", "windows", "share", "one-slash", "bare", "path", "escaped", "long"],
)
def test_any_form_of_the_resource_location(
    library: Library, expected: list[list[float]], resources: bytes | None
) -> None:
    fmu = Instance(library, resources=resources)
    fmu.start()
    assert walk(fmu) == expected
    fmu.free()


@pytest.mark.parametrize(
    "name",
    [b"/home/x/models/a b/Apnc.fmu", b"C:\\x\\Apnc.fmu", b"%s%n%d", b"\xc3\xa4", b"n" * 9999],
)
def test_any_instance_name_even_a_whole_path(library: Library, name: bytes) -> None:
    fmu = Instance(library, name=name)
    assert fmu.component
    assert fmu("fmi2DoStep", 0.0, TS, 1) == ERROR
    assert len(fmu.messages) == 1
    fmu.free()


def test_visible_changes_nothing(library: Library, expected: list[list[float]]) -> None:
    fmu = Instance(library, visible=True)
    fmu.start()
    assert walk(fmu) == expected
    fmu.free()


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"guid": "{00000000-0000-0000-0000-000000000000}"}, "guid"),
        ({"guid": None}, "guid"),
        ({"guid": " "}, "guid"),
        ({"kind": 0}, "co-simulation"),
        ({"kind": 7}, "co-simulation"),
        ({"name": None}, "name"),
        ({"name": b""}, "name"),
    ],
)
def test_instances_that_cannot_be_made(library: Library, changes: dict[str, Any], why: str) -> None:
    fmu = Instance(library, **changes)
    assert fmu.component is None
    assert len(fmu.log) == 1 and fmu.log[0][:2] == (ERROR, "logStatusError")
    assert why in fmu.messages[0]
    # nor does it crash when nobody listens
    assert Instance(library, **changes, logger=False).component is None
    assert Instance(library, **changes, callbacks=False).component is None


def test_memory_comes_from_the_importer_and_goes_back_to_it(
    library: Library, expected: list[list[float]]
) -> None:
    memory = Memory()
    fmu = Instance(library, memory=memory)
    assert memory.allocated > 0
    fmu.start()
    assert walk(fmu) == expected
    before = memory.allocated
    state = ctypes.c_void_p()
    assert fmu("fmi2GetFMUstate", ctypes.byref(state)) == OK
    assert memory.allocated == before + 1 and state.value in memory.held
    assert fmu("fmi2GetFMUstate", ctypes.byref(state)) == OK
    assert memory.allocated == before + 1
    assert fmu("fmi2FreeFMUstate", ctypes.byref(state)) == OK
    assert state.value is None
    fmu.free()
    assert memory.held == {} and memory.freed == memory.allocated


def test_out_of_memory_is_an_error_not_a_crash(library: Library) -> None:
    memory = Memory()
    memory.allocate = lambda count, size: 0  # type: ignore[method-assign]
    assert Instance(library, memory=memory).component is None
