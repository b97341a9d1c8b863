"""Samples and records of the plant in C, split into signals by name."""

from __future__ import annotations

import math

from apnc_core.types import Array
from apnc_plant.signals import PLANT_SIGNALS


def sample_size(n_legs: int) -> int:
    """Numbers in a sample, as ``plant_sample_size`` in C says."""
    return sum(math.prod(signal.shape(n_legs)) for signal in PLANT_SIGNALS)


def sample_signals(rows: Array, n_legs: int) -> dict[str, Array]:
    """Signals of samples as ``plant_sample`` writes them.

    Args:
        rows: a sample each, shape (samples, 9 + 19 n_legs).
        n_legs: number of legs.

    Returns:
        Every signal in ``PLANT_SIGNALS`` by name, samples along the first axis.
    """
    found, at = {}, 0
    for signal in PLANT_SIGNALS:
        shape = signal.shape(n_legs)
        end = at + math.prod(shape)
        found[signal.name] = rows[:, at:end].reshape(-1, *shape).copy()
        at = end
    return found


def record_signals(samples: Array, ticks: int, count: int, n_legs: int) -> dict[str, Array]:
    """The signals of a record that C wrote, as views into it.

    Args:
        samples: the signals one after the other, each of ``ticks`` times its size, shape (any,).
        ticks: samples there is room for.
        count: samples that were taken.
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
