"""Time of the FMU: which ticks a step runs, start and stop time, steps that are refused."""

from __future__ import annotations

import ctypes
import math

import pytest
from fmu_slave import SCALARS
from raw_fmu import ERROR, OK, TS, Instance, Library, fmu_in
from raw_walk import ticks_after, walk


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
    ("t", "h"),
    [
        (math.nan, TS), (0.0, math.nan), (math.inf, TS), (0.0, math.inf), (-math.inf, TS),
        (0.0, -TS), (0.0, -5e-324), (0.0, 1e308), (1.7e308, 1.7e308), (1.0, TS), (-1.0, TS),
        (0.0, 1e9),
    ],
)  # fmt: skip
def test_impossible_steps_are_refused_and_change_nothing(
    library: Library, t: float, h: float
) -> None:
    fmu = fmu_in(library, "stepping")
    assert fmu.step(t, h) == ERROR
    assert len(fmu.messages) == 1 and "step" in fmu.messages[0]
    tick = [SCALARS["tick"].value_reference]
    assert fmu.get(tick, "Integer") == [0]
    assert fmu.step(0.0, 5e-324) == OK
    assert fmu.step(0.0) == OK
    assert fmu.get(tick, "Integer") == [1]
    fmu.free()


def test_last_successful_time_is_the_end_of_the_last_step(library: Library) -> None:
    fmu = Instance(library)
    fmu.start(2.0)
    time = ctypes.c_double()
    assert fmu("fmi2GetRealStatus", 2, ctypes.byref(time)) == OK and time.value == 2.0
    fmu.step(2.0, 0.5)
    assert fmu("fmi2GetRealStatus", 2, ctypes.byref(time)) == OK and time.value == 2.5
    assert fmu.step(9.0) == ERROR
    assert fmu("fmi2GetRealStatus", 2, ctypes.byref(time)) == OK and time.value == 2.5
    fmu.free()


@pytest.mark.parametrize("start", [math.nan, math.inf, -math.inf])
def test_start_time_must_be_finite(library: Library, start: float) -> None:
    fmu = Instance(library)
    assert fmu("fmi2SetupExperiment", 0, 0.0, start, 0, 0.0) == ERROR
    assert "start time" in fmu.messages[0]
    fmu.free()


def test_without_setup_the_start_time_is_zero(
    library: Library, expected: list[list[float]]
) -> None:
    fmu = Instance(library)
    assert fmu("fmi2EnterInitializationMode") == OK
    assert fmu("fmi2ExitInitializationMode") == OK
    assert walk(fmu) == expected
    fmu.free()


@pytest.mark.parametrize("stop", [-1.0, math.nan, -math.inf])
def test_stop_time_before_the_start_is_refused(library: Library, stop: float) -> None:
    fmu = Instance(library)
    assert fmu("fmi2SetupExperiment", 0, 0.0, 0.0, 1, stop) == ERROR
    assert "stop time" in fmu.messages[0]
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


@pytest.mark.parametrize("away", [-0.51, -0.49, 0.49, 0.51])
def test_a_step_starts_within_half_a_tick_of_the_end_of_the_one_before(
    library: Library, away: float
) -> None:
    fmu = Instance(library)
    fmu.start()
    assert fmu.step(0.0) == OK
    assert fmu.step((1.0 + away) * TS) == (OK if abs(away) < 0.5 else ERROR)
    assert fmu.log[1:] == [] or "the one before ended at" in fmu.messages[0]
    fmu.free()
