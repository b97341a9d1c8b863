"""Traces grow as they go, and cost little more than what they hold."""

import tracemalloc

import numpy as np
import pytest

from apnc_plant.trace import CHUNK, Trace


def split(rows: np.ndarray) -> dict[str, np.ndarray]:
    return {"time": rows[:, 0].copy(), "pair": rows[:, 1:].reshape(-1, 1, 2) * [1.0, -1.0]}


@pytest.mark.parametrize("rows", [1, CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK])
def test_signals_hold_every_row_in_order(rows: int) -> None:
    time, pair = np.zeros(1), np.zeros(2)
    trace = Trace([time, pair], split)
    for k in range(rows):
        time[0], pair[:] = k, (2 * k, 3 * k)
        trace.take()
    assert len(trace) == rows
    signals, ticks = trace.signals(), np.arange(rows)
    np.testing.assert_array_equal(signals["time"], ticks)
    np.testing.assert_array_equal(signals["pair"][:, 0], np.stack([2.0 * ticks, -3.0 * ticks], 1))


def test_nothing_taken_gives_signals_without_rows() -> None:
    signals = Trace([np.zeros(1), np.zeros(2)], split).signals()
    assert {name: values.shape for name, values in signals.items()} == {
        "time": (0,),
        "pair": (0, 1, 2),
    }


def test_signals_can_be_taken_on_the_way() -> None:
    trace = Trace([np.ones(1), np.zeros(2)], split)
    trace.take()
    first = trace.signals()["time"]
    trace.take()
    assert len(first) == 1
    assert len(trace.signals()["time"]) == 2


def test_memory_is_twice_the_data() -> None:
    width = 100
    parts = [np.zeros(width)]
    tracemalloc.start()
    trace = Trace(parts, lambda rows: {"a": rows[:, :50].copy(), "b": rows[:, 50:] * 1.0})
    empty, _ = tracemalloc.get_traced_memory()
    assert empty < 1e5
    rows = 20 * CHUNK
    for _ in range(rows):
        trace.take()
    trace.signals()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2.2 * 8 * width * rows
