"""What the FMU promises an importer: time, faults, ranges, reset, saved states."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from fmpy import fmi2
from fmpy.fmi1 import FMICallException
from fmu_slave import TS, FMU2Probe, slave

from apnc_core.interface import Parameters
from apnc_core.schema import Causality, Type, Variable
from apnc_core.variables import variables_of

START_HIP = 0.25 + Parameters().a1 * Parameters().o1_start
LOADS = [3.0, 9.0, 5.0, 8.0]


def outputs_at(path: Path, step: float, until: float, start: float = 0.0) -> dict[int, list[float]]:
    """Outputs after the step that ends at or after each tick, by tick number."""
    seen: dict[int, list[float]] = {}
    with slave(path) as fmu:
        fmu.start(start)
        n = 0
        while n * step < until:
            fmu.loads([load * (1 + math.floor(n * step + 1e-9)) for load in LOADS])
            fmu.step(start + n * step, step)
            n += 1
            seen[int(fmu.get("tick"))] = fmu.all_outputs()
    return seen


@pytest.mark.parametrize("factor", [1 / 7, 1 / 2, 3, 12])
def test_outputs_do_not_depend_on_the_communication_step(fmu4: Path, factor: float) -> None:
    # the loads change every second, a whole number of every communication step
    every_tick = outputs_at(fmu4, TS, 3.0)
    other = outputs_at(fmu4, factor * TS, 3.0)
    common = sorted(set(every_tick) & set(other))
    assert len(common) >= 180 // max(1, factor)
    for tick in common:
        assert other[tick] == every_tick[tick]


@pytest.mark.parametrize("start", [-3.0, 0.1, 1e6])
def test_any_start_time_gives_the_same_outputs(fmu4: Path, start: float) -> None:
    at_zero, later = outputs_at(fmu4, TS, 1.0), outputs_at(fmu4, TS, 1.0, start)
    assert [v[:-8] for v in later.values()] == [v[:-8] for v in at_zero.values()]


def test_tick_is_due_at_the_start_of_the_step(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.start()
        fmu.step(0.0, 0.5 * TS)
        assert fmu.get("tick") == 1
        fmu.step(0.5 * TS, 0.5 * TS)
        assert fmu.get("tick") == 1
        fmu.step(TS, 10 * TS)
        assert fmu.get("tick") == 11


def test_outputs_hold_between_ticks(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.start()
        fmu.step(0.0, 0.25 * TS)
        before = fmu.all_outputs()
        fmu.loads(LOADS)
        fmu.step(0.25 * TS, 0.25 * TS)
        assert fmu.all_outputs() == before


@pytest.mark.parametrize("step", [0.01666666666666667, 0.0166666667, 0.0166666666])
def test_an_inexact_step_neither_loses_nor_doubles_a_tick(fmu4: Path, step: float) -> None:
    with slave(fmu4) as fmu:
        fmu.start()
        t = 0.0
        for n in range(3000):
            fmu.step(t, step)
            t += step
            assert fmu.get("tick") == n + 1


def test_a_step_too_small_to_matter_is_a_success(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.start()
        fmu.step(0.0)
        assert fmu.step(TS, 1.1e-15) == fmi2.fmi2OK
        assert fmu.get("tick") == 1
        assert fmu.step(TS, TS) == fmi2.fmi2OK
        assert fmu.get("tick") == 2


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, -0.5])
def test_unusable_load_counts_as_zero_and_is_reported_once(fmu4: Path, bad: float) -> None:
    with slave(fmu4) as fmu, slave(fmu4) as twin:
        fmu.start()
        twin.start()
        statuses = []
        for n in range(30):
            spoiled = 10 <= n < 20
            fmu.loads([LOADS[0], bad if spoiled else LOADS[1], *LOADS[2:]])
            twin.loads([LOADS[0], 0.0 if spoiled else LOADS[1], *LOADS[2:]])
            statuses.append(fmu.step(n * TS))
            twin.step(n * TS)
            assert fmu.get("leg[2].fault") == spoiled
            assert fmu.get("leg[1].fault") == 0
            assert fmu.get("leg[2].theta_hip") == twin.get("leg[2].theta_hip")
        assert [n for n, s in enumerate(statuses) if s == fmi2.fmi2Warning] == [10]
        assert len(fmu.messages) == 1 and "leg[2].grf" in fmu.messages[0]
        assert twin.messages == []


@pytest.mark.parametrize(
    "v",
    [
        v
        for v in variables_of(Causality.parameter)
        if v.type in (Type.real, Type.integer, Type.enumeration)
    ],
    ids=lambda v: v.name,
)
def test_every_range_is_enforced_by_name(fmu4: Path, v: Variable) -> None:
    name = v.scalar_name(0)
    high = len(v.enumeration.items) if v.enumeration else v.max
    low = 1 if v.enumeration else v.min
    for bad in (low - 1, high + 1):
        with slave(fmu4) as fmu:
            fmu.setupExperiment()
            fmu.enterInitializationMode()
            fmu.put(name, bad)
            with pytest.raises(FMICallException, match="ExitInitializationMode"):
                fmu.exitInitializationMode()
            assert f"{name} = {bad:g} is out of range" in fmu.messages[0]
            fmu.put(name, high)
            fmu.exitInitializationMode()


def test_not_a_number_is_out_of_range(fmu4: Path) -> None:
    with slave(fmu4) as fmu, pytest.raises(FMICallException):
        fmu.start(xi=math.nan)


def test_tunable_parameters_act_at_once_and_fixed_ones_are_refused(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.start()
        fmu.step(0.0)
        fmu.put("b1", 0.3)
        fmu.step(TS)
        expected = 0.3 + Parameters().a1 * fmu.get("leg[1].o1")
        assert fmu.get("leg[1].theta_hip") == pytest.approx(expected)
        for name, value, why in (("Ts", 0.02, "fixed"), ("b1", 99.0, "out of range")):
            with pytest.raises(FMICallException):
                fmu.put(name, value)
            assert why in fmu.messages[-1]
        fmu.step(2 * TS)
        assert fmu.get("b1") == 0.3


def test_commands_out_of_range_are_limited_and_reported_once(fmu4: Path) -> None:
    with slave(fmu4) as fmu, slave(fmu4) as twin:
        fmu.start()
        twin.start()
        for n in range(20):
            fmu.put("turn", 5.0)
            twin.put("turn", 1.0)
            fmu.step(n * TS)
            twin.step(n * TS)
        assert fmu.get("leg[1].theta_hip") == twin.get("leg[1].theta_hip")
        assert len(fmu.messages) == 1 and fmu.messages[0].startswith("turn = 5")


def walk_some(fmu: FMU2Probe, ticks: range) -> list[list[float]]:
    rng = np.random.default_rng(7)
    loads = rng.uniform(0, 20, (ticks.stop, 4)).tolist()
    seen = []
    for n in ticks:
        fmu.loads(loads[n])
        fmu.step(n * TS)
        seen.append(fmu.all_outputs())
    return seen


def test_reset_equals_fresh(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.start()
        first = walk_some(fmu, range(200))
        fmu.reset()
        fmu.start()
        assert walk_some(fmu, range(200)) == first


def test_saved_state_continues_bit_for_bit(fmu4: Path) -> None:
    with slave(fmu4) as fmu, slave(fmu4) as other:
        fmu.start()
        walk_some(fmu, range(150))
        state = fmu.getFMUstate()
        blob = fmu.serializeFMUstate(state)
        rest = walk_some(fmu, range(150, 300))
        fmu.setFMUstate(state)
        assert walk_some(fmu, range(150, 300)) == rest
        fmu.freeFMUstate(state)
        # into another instance that has not even been initialised
        moved = other.deSerializeFMUstate(blob)
        other.setFMUstate(moved)
        assert walk_some(other, range(150, 300)) == rest
        other.freeFMUstate(moved)


def test_outputs_are_readable_before_the_first_step(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.setupExperiment()
        fmu.enterInitializationMode()
        fmu.put("b1", 0.25)
        assert fmu.get("leg[3].theta_hip") == pytest.approx(START_HIP)
        fmu.exitInitializationMode()
        assert fmu.get("leg[3].theta_hip") == pytest.approx(START_HIP)


def test_quiet_unless_logging_is_on(fmu4: Path) -> None:
    with slave(fmu4, logging=False) as fmu:
        fmu.start()
        fmu.loads([math.nan] * 4)
        assert fmu.step(0.0) == fmi2.fmi2Warning
        assert fmu.log == []


def test_wrong_guid_is_refused_with_a_message(fmu4: Path) -> None:
    with slave(fmu4) as fmu:
        fmu.guid = "{wrong}"
        component = fmu.component
        with pytest.raises(Exception, match="instantiate"):
            fmu.instantiate(callbacks=fmu.own, loggingOn=True)
        fmu.component = component
        assert "guid" in fmu.messages[-1]
