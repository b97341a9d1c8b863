"""Saved states, reset, and many instances at once, for every method."""

from __future__ import annotations

import ctypes
import gc
import threading

import numpy as np
import pytest
from fmu_slave import SCALARS
from raw_fmu import OK, TS, Instance, Library, Memory

from apnc_core.enumerations import KappaRule, Method, PhaseMeasure
from apnc_core.schema import Causality, Type

RESULTS = [s for s in SCALARS.values() if s.variable.causality in ("output", "local")]
REALS = [s.value_reference for s in RESULTS if s.variable.type is Type.real]
INTEGERS = [s.value_reference for s in RESULTS if s.variable.type is Type.integer]
BOOLEANS = [s.value_reference for s in RESULTS if s.variable.type is Type.boolean]
INPUTS = [SCALARS[f"leg[{i}].grf"].value_reference for i in range(1, 5)]
INPUTS += [SCALARS["MI"].value_reference, SCALARS["turn"].value_reference]
TICKS = 400

# every part of the state is in use: both phase measures, and couplings that switch on
SETTINGS = [
    {"method": method, "phase_measure": measure, "kappa_rule": KappaRule.printed}
    for method in Method
    for measure in PhaseMeasure
]
NAMES = [f"{s['method'].name}-{s['phase_measure'].name}" for s in SETTINGS]


def inputs(seed: int) -> list[list[float]]:
    rng = np.random.default_rng(seed)
    loads = np.where(rng.random((TICKS, 4)) < 0.5, rng.uniform(0, 20, (TICKS, 4)), 0.0)
    commands = np.column_stack([rng.uniform(0.02, 0.3, TICKS), rng.uniform(-1, 1, TICKS)])
    return np.hstack([loads, commands]).tolist()  # type: ignore[no-any-return]


def started(library: Library, settings: dict[str, int]) -> Instance:
    fmu = Instance(library)
    configure(fmu, settings)
    return fmu


def configure(fmu: Instance, settings: dict[str, int]) -> None:
    assert fmu("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0) == OK
    assert fmu("fmi2EnterInitializationMode") == OK
    references = [SCALARS[name].value_reference for name in settings]
    assert fmu.set(references, [int(v) for v in settings.values()], "Integer") == OK
    assert fmu("fmi2ExitInitializationMode") == OK


def everything(fmu: Instance) -> tuple[bytes, ...]:
    """All outputs, bit for bit."""
    return (
        np.array(fmu.get(REALS)).tobytes(),
        np.array(fmu.get(INTEGERS, "Integer")).tobytes(),
        np.array(fmu.get(BOOLEANS, "Boolean")).tobytes(),
    )


def tick(fmu: Instance, n: int, values: list[float]) -> tuple[bytes, ...]:
    assert fmu.set(INPUTS, values) == OK
    assert fmu.step(n * TS) == OK, fmu.messages
    return everything(fmu)


def walk(fmu: Instance, seed: int, first: int = 0, last: int = TICKS) -> list[tuple[bytes, ...]]:
    given = inputs(seed)
    return [tick(fmu, n, given[n]) for n in range(first, last)]


def saved(fmu: Instance) -> bytes:
    state, size = ctypes.c_void_p(), ctypes.c_size_t()
    assert fmu("fmi2GetFMUstate", ctypes.byref(state)) == OK
    assert fmu("fmi2SerializedFMUstateSize", state, ctypes.byref(size)) == OK
    buffer = ctypes.create_string_buffer(size.value)
    assert fmu("fmi2SerializeFMUstate", state, buffer, size) == OK
    assert fmu("fmi2FreeFMUstate", ctypes.byref(state)) == OK
    return buffer.raw


def restore(fmu: Instance, blob: bytes) -> None:
    state = ctypes.c_void_p()
    assert fmu("fmi2DeSerializeFMUstate", blob, len(blob), ctypes.byref(state)) == OK, fmu.messages
    assert fmu("fmi2SetFMUstate", state) == OK
    assert fmu("fmi2FreeFMUstate", ctypes.byref(state)) == OK


@pytest.mark.parametrize("settings", SETTINGS, ids=NAMES)
def test_a_state_saved_mid_run_continues_bit_for_bit(
    library: Library, settings: dict[str, int]
) -> None:
    fmu = started(library, settings)
    walk(fmu, 1, 0, 250)
    blob = saved(fmu)
    at_save = everything(fmu)
    rest = walk(fmu, 1, 250)
    assert len(set(rest)) == len(rest)  # it did move on
    restore(fmu, blob)
    assert everything(fmu) == at_save
    assert saved(fmu) == blob
    assert walk(fmu, 1, 250) == rest
    # in another instance, which has done something else meanwhile
    other = started(library, SETTINGS[0])
    walk(other, 2, 0, 100)
    restore(other, blob)
    assert walk(other, 1, 250) == rest
    fmu.free()
    other.free()


@pytest.mark.parametrize("state", ["instantiated", "initialization", "terminated"])
def test_states_saved_outside_a_run_come_back(library: Library, state: str) -> None:
    fmu = Instance(library)
    b1 = [SCALARS["b1"].value_reference]
    assert fmu.set(b1, [0.25]) == OK
    if state == "initialization":
        assert fmu("fmi2EnterInitializationMode") == OK
    elif state == "terminated":
        fmu.start()
        assert fmu("fmi2Terminate") == OK
    blob = saved(fmu)
    assert fmu("fmi2Reset") == OK
    restore(fmu, blob)
    may_step = {"instantiated": "fmi2EnterInitializationMode",
                "initialization": "fmi2ExitInitializationMode",
                "terminated": "fmi2Reset"}  # fmt: skip
    assert fmu(may_step[state]) == OK
    if state != "terminated":
        if state == "instantiated":
            assert fmu("fmi2ExitInitializationMode") == OK
        assert fmu.get(b1) == [0.25]
    fmu.free()


@pytest.mark.parametrize("settings", SETTINGS, ids=NAMES)
def test_reset_equals_fresh(library: Library, settings: dict[str, int]) -> None:
    fmu = started(library, settings)
    untouched = Instance(library)
    first = walk(fmu, 3)
    assert fmu("fmi2Reset") == OK
    assert saved(fmu) == saved(untouched)
    configure(fmu, settings)
    assert walk(fmu, 3) == first
    fmu.free()
    untouched.free()


def test_interleaved_instances_do_not_see_each_other(library: Library) -> None:
    alone = []
    for seed, settings in enumerate(SETTINGS):
        fmu = started(library, settings)
        alone.append(walk(fmu, seed))
        fmu.free()
    together = [started(library, settings) for settings in SETTINGS]
    given = [inputs(seed) for seed in range(len(SETTINGS))]
    seen: list[list[tuple[bytes, ...]]] = [[] for _ in SETTINGS]
    for n in range(TICKS):
        for k, fmu in enumerate(together):
            seen[k].append(tick(fmu, n, given[k][n]))
    assert seen == alone
    for fmu in together:
        fmu.free()


def test_instances_in_threads_do_not_see_each_other(library: Library) -> None:
    """Calls through ctypes leave Python's lock, so the steps do run at the same time."""
    alone = {}
    for seed, settings in enumerate(SETTINGS):
        fmu = started(library, settings)
        alone[seed] = walk(fmu, seed)
        fmu.free()
    seen: dict[int, list[tuple[bytes, ...]]] = {}
    gate = threading.Barrier(len(SETTINGS))

    def work(seed: int) -> None:
        gate.wait()
        fmu = started(library, SETTINGS[seed])
        seen[seed] = walk(fmu, seed)
        fmu.free()

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(len(SETTINGS))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert seen == alone


def live_and_die(library: Library, memory: Memory | None) -> None:
    fmu = Instance(library, name=b"n" * 1000, memory=memory, logger=False)
    fmu.start()
    fmu.step(0.0)
    restore(fmu, saved(fmu))
    fmu.free()


class MallocInfo(ctypes.Structure):
    """What glibc knows of its heap; ``uordblks`` is the bytes in use."""

    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
        "fordblks", "keepcost",
    )]  # fmt: skip


def bytes_in_use() -> int:
    mallinfo = getattr(ctypes.CDLL(None), "mallinfo2", None)
    if mallinfo is None:
        pytest.skip("mallinfo2 is missing (glibc 2.33 or newer)")
    mallinfo.restype = MallocInfo
    return int(mallinfo().uordblks)


def test_ten_thousand_lives_leak_nothing(library: Library) -> None:
    for _ in range(500):
        live_and_die(library, None)
    gc.collect()  # what earlier tests left behind must not be freed, or moved, in between
    before = bytes_in_use()
    for _ in range(10_000):
        live_and_die(library, None)
    gc.collect()
    # the names alone, the smallest that is allocated, would be ten megabytes
    assert bytes_in_use() - before < 10_000


def test_ten_thousand_lives_give_all_memory_back_to_the_importer(library: Library) -> None:
    memory = Memory()
    for _ in range(10_000):
        live_and_die(library, memory)
    assert memory.held == {}
    # instance, name, one saved and one restored state
    assert memory.allocated == memory.freed == 40_000


def test_outputs_are_of_all_types() -> None:
    assert REALS and INTEGERS and BOOLEANS
    assert all(s.variable.causality is not Causality.input for s in RESULTS)
