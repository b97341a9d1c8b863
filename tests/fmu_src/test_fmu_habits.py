"""What importers are known to do to an FMU; each habit is one test."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterator

import pytest
from lxml import etree
from raw_fmu import ERROR, OK, TS, Instance, Library, Memory
from slave import SCALARS

from apnc_core.interface import Parameters
from apnc_core.schema import Causality, Type

SWING = Parameters().a1 * Parameters().o1_start

REAL_OUTPUTS = [
    s.value_reference
    for s in SCALARS.values()
    if s.variable.causality is Causality.output and s.variable.type is Type.real
]
LOADS = [SCALARS[f"leg[{i}].grf"].value_reference for i in range(1, 5)]
TICK = [SCALARS["tick"].value_reference]
B1 = [SCALARS["b1"].value_reference]
HIP = [SCALARS["leg[1].theta_hip"].value_reference]


def walk(fmu: Instance, ticks: int = 60, start: float = 0.0, step: float = TS) -> list[list[float]]:
    seen = []
    for n in range(ticks):
        fmu.set(LOADS, [3.0 + n % 7, 9.0, 5.0, 8.0 - n % 5])
        assert fmu.step(start + n * step, step) == OK, fmu.messages
        seen.append(fmu.get(REAL_OUTPUTS))
    return seen


@pytest.fixture
def expected(library: Library) -> Iterator[list[list[float]]]:
    fmu = Instance(library)
    fmu.start()
    yield walk(fmu)
    fmu.free()


def ticks_after(fmu: Instance) -> int:
    return int(fmu.get(TICK, "Integer")[0])


@pytest.mark.parametrize("seconds", [3600])
def test_an_hour_without_a_tick_lost_or_doubled(library: Library, seconds: int) -> None:
    fmu = Instance(library)
    fmu.start()
    t = 0.0
    for n in range(60 * seconds):
        assert fmu.step(t, TS) == OK
        t += TS  # adds up its rounding, as importers do
        assert ticks_after(fmu) == n + 1
    fmu.free()


@pytest.mark.parametrize("step_ns", [16_666_666, 16_666_667])
def test_integer_nanoseconds_drift_but_run_each_tick_when_it_is_due(
    library: Library, step_ns: int
) -> None:
    fmu = Instance(library)
    fmu.start()
    before = 0
    for n in range(20_000):
        assert fmu.step(n * step_ns * 1e-9, step_ns * 1e-9) == OK
        end = (n + 1) * step_ns * 1e-9
        ticks = ticks_after(fmu)
        # all ticks due before the end of the step, give or take a ten-thousandth of Ts
        assert math.ceil(end / TS - 1.1e-4) <= ticks <= math.ceil(end / TS + 1e-9)
        assert ticks - before in (1, 2)
        before = ticks
    fmu.free()


def test_irregular_steps_run_what_is_due(library: Library) -> None:
    fmu = Instance(library)
    fmu.start()
    t, total = 0.0, 0
    for n in range(3000):
        h = TS * (0.01, 0.37, 1.0, 2.9, 0.0, 17.3)[n % 6]
        assert fmu.step(t, h) == OK
        t += h
        due = math.ceil(t / TS - 1e-4)
        assert ticks_after(fmu) == due >= total
        total = due
    fmu.free()


def test_a_run_that_ends_with_a_tiny_step(library: Library) -> None:
    fmu = Instance(library)
    fmu.start()
    assert fmu.step(0.0) == OK
    assert fmu.step(TS, 1.1e-15) == OK
    assert fmu.step(TS + 1.1e-15, 0.0) == OK
    assert ticks_after(fmu) == 1
    fmu.free()


def test_steps_written_with_sixteen_digits(library: Library, expected: list[list[float]]) -> None:
    fmu = Instance(library)
    fmu.start()
    assert walk(fmu, step=0.01666666666666667) == expected
    fmu.free()


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


@pytest.mark.parametrize("stop", [0.0, -1.0, math.inf, -math.inf, math.nan, 1e308])
def test_stop_time_not_defined_may_be_anything(library: Library, stop: float) -> None:
    fmu = Instance(library)
    assert fmu("fmi2SetupExperiment", 1, math.nan, 5.0, 0, stop) == OK
    assert fmu("fmi2EnterInitializationMode") == OK
    assert fmu("fmi2ExitInitializationMode") == OK
    assert fmu.step(5.0) == OK
    fmu.free()


def fmu_until(library: Library, stop: float) -> Instance:
    fmu = Instance(library)
    assert fmu("fmi2SetupExperiment", 0, 0.0, 0.0, 1, stop) == OK
    assert fmu("fmi2EnterInitializationMode") == OK
    assert fmu("fmi2ExitInitializationMode") == OK
    return fmu


def test_a_step_beyond_the_stop_time_is_an_error_and_changes_nothing(library: Library) -> None:
    fmu = fmu_until(library, 2 * TS)
    assert [fmu.step(n * TS) for n in range(3)] == [OK, OK, ERROR]
    assert "beyond the stop time" in fmu.messages[0]
    assert ticks_after(fmu) == 2
    # a longer run is another experiment
    assert fmu("fmi2Reset") == OK
    fmu.start()
    assert [fmu.step(n * TS) for n in range(3)] == [OK] * 3
    fmu.free()


@pytest.mark.parametrize(("over", "status"), [(0.49, OK), (0.51, ERROR)])
def test_the_last_step_may_be_rounded_by_less_than_half_a_tick(
    library: Library, over: float, status: int
) -> None:
    fmu = fmu_until(library, TS)
    assert fmu.step(0.0, (1.0 + over) * TS) == status
    fmu.free()


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


def test_without_setup_the_start_time_is_zero(
    library: Library, expected: list[list[float]]
) -> None:
    fmu = Instance(library)
    assert fmu("fmi2EnterInitializationMode") == OK
    assert fmu("fmi2ExitInitializationMode") == OK
    assert walk(fmu) == expected
    fmu.free()


def test_version_and_platform_read_exactly_so(library: Library) -> None:
    assert library.calls.fmi2GetVersion() == b"2.0"
    assert library.calls.fmi2GetTypesPlatform() == b"default"


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
