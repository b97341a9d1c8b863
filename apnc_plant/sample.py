"""Splits samples and records of the plant in C into signals by name."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable

from apnc_core.types import Array
from apnc_plant.signals import PLANT_SIGNALS, Signal


def sample_size(n_legs: int) -> int:
    """Count of numbers in a sample, the same as ``plant_sample_size`` in C."""
    return record_size(PLANT_SIGNALS, n_legs)


def sample_signals(samples: Array, n_legs: int) -> dict[str, Array]:
    """Signals of samples as ``plant_sample`` writes them.

    Args:
        samples: one sample per row of the array, shape (samples, 9 + 19 n_legs).
        n_legs: number of legs.

    Returns:
        Every signal in ``PLANT_SIGNALS`` by name, samples along the first axis.
    """
    found, at = {}, 0
    for signal in PLANT_SIGNALS:
        shape = signal.shape(n_legs)
        end = at + math.prod(shape)
        found[signal.name] = samples[:, at:end].reshape(-1, *shape).copy()
        at = end
    return found


def recorded_signals(names: Container[str] | None) -> tuple[Signal, ...]:
    """Signals of ``PLANT_SIGNALS`` that a record of C holds, in its order.

    Args:
        names: those that are wanted; None: all.
    """
    return tuple(s for s in PLANT_SIGNALS if names is None or s.name in names)


def signal_bits(signals: Iterable[Signal]) -> int:
    """The signals as ``loop_run.plant_signals`` of C."""
    return sum(1 << PLANT_SIGNALS.index(signal) for signal in signals)


def record_size(signals: Iterable[Signal], n_legs: int) -> int:
    """Count of numbers that a record takes for a tick."""
    return sum(math.prod(signal.shape(n_legs)) for signal in signals)


def record_signals(
    samples: Array, signals: Iterable[Signal], ticks: int, count: int, n_legs: int
) -> dict[str, Array]:
    """Signals of a record that C wrote, as views into it.

    Args:
        samples: the signals one after the other, each with ``ticks`` times its size, shape (any,).
        signals: what was recorded, see :func:`recorded_signals`.
        ticks: number of samples that the record has room for.
        count: number of samples that were taken.
        n_legs: number of legs.

    Returns:
        Every recorded signal, samples along the first axis.
    """
    found, at = {}, 0
    for signal in signals:
        shape = (ticks, *signal.shape(n_legs))
        end = at + math.prod(shape)
        found[signal.name] = samples[at:end].reshape(shape)[:count]
        at = end
    return found
