"""Splits samples and records of the plant in C into signals by name."""

from __future__ import annotations

import math

from apnc_core.types import Array
from apnc_plant.signals import PLANT_SIGNALS


def sample_size(n_legs: int) -> int:
    """Count of numbers in a sample, the same as ``plant_sample_size`` in C."""
    return sum(math.prod(signal.shape(n_legs)) for signal in PLANT_SIGNALS)


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


def record_signals(samples: Array, ticks: int, count: int, n_legs: int) -> dict[str, Array]:
    """Signals of a record that C wrote, as views into it.

    Args:
        samples: the signals one after the other, each with ``ticks`` times its size, shape (any,).
        ticks: number of samples that the record has room for.
        count: number of samples that were taken.
        n_legs: number of legs.

    Returns:
        Every signal of ``PLANT_SIGNALS``, samples along the first axis.
    """
    found, at = {}, 0
    for signal in PLANT_SIGNALS:
        shape = (ticks, *signal.shape(n_legs))
        end = at + math.prod(shape)
        found[signal.name] = samples[at:end].reshape(shape)[:count]
        at = end
    return found
