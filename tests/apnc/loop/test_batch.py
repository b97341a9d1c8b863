"""Closed loops at every instruction set of this machine."""

from __future__ import annotations

import gc
import weakref

import numpy as np
import pytest

import apnc
from apnc.loop.batch import Batch, Run, contacts_of, fmu_of, lanes_of
from apnc.loop.controller_library import ControllerLibrary, Recording, controller_library
from apnc_plant.library import library

EXPERIMENT = apnc.Experiment(engine="compiled", duration=2.0)


def record_at(level: int | None, *, single: bool) -> apnc.Record:
    batch = Batch(lanes_of(EXPERIMENT), contacts_of([EXPERIMENT]), single=single, level=level)
    run = Run(EXPERIMENT, batch.controller)
    batch.begin(run)
    while not batch.walk(1000):
        pass
    return run.record()


@pytest.mark.parametrize("single", [True, False])
def test_the_bits_of_a_run_are_the_same_at_each(single: bool) -> None:
    best = record_at(None, single=single)
    for level in range(library()[1].plant_best_level() + 1):
        record = record_at(level, single=single)
        for name, values in best.signals.items():
            np.testing.assert_array_equal(record.signals[name], values)


def test_what_c_reads_lives_as_long_as_the_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    controller = controller_library(fmu_of(EXPERIMENT))
    made = []

    def alone(signals: frozenset[str] | None) -> Recording:
        """As for a thread whose result the cache did not take, since another was quicker."""
        recording = ControllerLibrary._recording(controller, signals)
        made.append(weakref.ref(recording))
        return recording

    monkeypatch.setattr(controller, "recording", alone)
    batch = Batch(lanes_of(EXPERIMENT), 1)
    gc.collect()
    assert batch.controller is controller and made[0]() is not None


def test_the_level_decides_how_many_walk_side_by_side() -> None:
    _, lib = library()
    for level in range(lib.plant_best_level() + 1):
        batch = Batch(lanes_of(EXPERIMENT), 1, level=level)
        assert batch.size == lib.plant_lanes(lib.PLANT_ROBOTS, level)


@pytest.mark.parametrize("level", [-1, 3])
def test_an_instruction_set_that_is_not_there_is_refused(level: int) -> None:
    with pytest.raises(ValueError, match=rf"level is {level}; allowed on this machine: 0 to "):
        Batch(lanes_of(EXPERIMENT), 1, level=level)
