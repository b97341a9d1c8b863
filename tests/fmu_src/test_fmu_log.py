"""Log of the FMU: its categories, when it is quiet, and importers without a logger."""

from __future__ import annotations

import ctypes
import math

import pytest
from lxml import etree
from raw_fmu import ERROR, OK, TS, Instance, Library
from raw_walk import LOADS, walk


def categories(*names: bytes | None) -> ctypes.Array[ctypes.c_char_p]:
    return (ctypes.c_char_p * len(names))(*names)


@pytest.mark.parametrize("name", [None, b"", b"logAll", b"logstatuserror", b"\xff"])
def test_a_null_or_unlisted_log_category_is_refused_without_harm(
    library: Library, name: bytes | None
) -> None:
    fmu = Instance(library)
    chosen = categories(b"logStatusError", name)
    assert fmu("fmi2SetDebugLogging", 1, 2, chosen) == ERROR
    assert "category" in fmu.messages[0]
    fmu.start()
    # what was on stays on
    assert [kind for _, kind, _ in fmu.log] == ["logStatusError", "logEvents"]
    fmu.free()


def test_only_the_chosen_categories_are_logged(library: Library) -> None:
    fmu = Instance(library)
    assert fmu("fmi2SetDebugLogging", 1, 1, categories(b"logStatusWarning")) == OK
    fmu.start()
    fmu.set(LOADS, [math.nan] * 4)
    fmu.step(0.0)
    fmu.step(100.0)  # an error, of another category
    assert {kind for _, kind, _ in fmu.log} == {"logStatusWarning"}
    assert fmu("fmi2SetDebugLogging", 1, 0, None) == OK
    fmu.step(100.0)
    assert fmu.log[-1][1] == "logStatusError"
    fmu.free()


def test_only_listed_categories_are_ever_used(library: Library) -> None:
    root = etree.parse(str(library.folder / "modelDescription.xml"))
    listed = {category.get("name") for category in root.findall("LogCategories/Category")}
    fmu = Instance(library)
    fmu.step(0.0)
    fmu.start()
    fmu.set(LOADS, [math.nan] * 4)
    fmu.step(0.0)
    used = {kind for _, kind, _ in fmu.log}
    assert used == listed
    fmu.free()


@pytest.mark.parametrize("switch", ["at instantiation", "later"])
def test_quiet_unless_logging_is_on(library: Library, switch: str) -> None:
    fmu = Instance(library, logging=switch == "later")
    if switch == "later":
        assert fmu("fmi2SetDebugLogging", 0, 0, None) == OK
    assert fmu.step(0.0) == ERROR
    fmu.start()
    fmu.set(LOADS, [math.nan] * 4)
    fmu.step(0.0)
    assert fmu.log == []
    fmu.free()


@pytest.mark.parametrize("callbacks", [True, False])
def test_no_logger_and_no_callbacks_at_all(
    library: Library, expected: list[list[float]], callbacks: bool
) -> None:
    fmu = Instance(library, logger=False, callbacks=callbacks)
    assert fmu.step(0.0) == ERROR
    fmu.start()
    assert walk(fmu) == expected
    fmu.free()


def long_steps(fmu: Instance) -> list[str]:
    return [text for _, kind, text in fmu.log if kind == "logStatusWarning"]


def test_a_step_longer_than_a_tick_is_reported_once(library: Library) -> None:
    fmu = Instance(library)
    fmu.start()
    assert fmu.step(0.0) == OK
    assert fmu.step(TS, 1.00001 * TS) == OK  # rounded, as whole nanoseconds are
    assert long_steps(fmu) == []
    assert fmu.step(2.00001 * TS, 1 / 15) == OK
    (said,) = long_steps(fmu)
    assert "0.0666667 s from 0.0333" in said and "longer than a tick, 0.0166667 s" in said
    assert fmu.step(6.00001 * TS, 1 / 15) == OK
    assert len(long_steps(fmu)) == 1
    # a new run says it anew
    assert fmu("fmi2Reset") == OK
    fmu.start()
    assert fmu.step(0.0, 1 / 15) == OK
    assert len(long_steps(fmu)) == 2
    fmu.free()


def test_a_long_step_that_is_refused_is_no_long_step(library: Library) -> None:
    fmu = Instance(library)
    fmu.start()
    assert fmu.step(0.0, 1e9) == ERROR
    assert long_steps(fmu) == []
    fmu.free()
