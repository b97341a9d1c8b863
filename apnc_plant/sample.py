"""Samples and records of the plant in C, split into channels by name."""

from __future__ import annotations

import math

from apnc_core.types import Array
from apnc_plant.channels import PLANT_CHANNELS


def sample_size(n_legs: int) -> int:
    """Numbers in a sample, as ``plant_sample_size`` in C says."""
    return sum(math.prod(channel.shape(n_legs)) for channel in PLANT_CHANNELS)


def sample_channels(rows: Array, n_legs: int) -> dict[str, Array]:
    """Channels of samples as ``plant_sample`` writes them.

    Args:
        rows: a sample each, shape (samples, 9 + 19 n_legs).
        n_legs: number of legs.

    Returns:
        Every channel in ``PLANT_CHANNELS`` by name, samples along the first axis.
    """
    found, at = {}, 0
    for channel in PLANT_CHANNELS:
        shape = channel.shape(n_legs)
        end = at + math.prod(shape)
        found[channel.name] = rows[:, at:end].reshape(-1, *shape).copy()
        at = end
    return found


def record_channels(samples: Array, ticks: int, count: int, n_legs: int) -> dict[str, Array]:
    """The channels of a record that C wrote, as views into it.

    Args:
        samples: the channels one after the other, each of ``ticks`` times its size, shape (any,).
        ticks: samples there is room for.
        count: samples that were taken.
        n_legs: number of legs.

    Returns:
        Every channel of ``PLANT_CHANNELS``, samples along the first axis.
    """
    found, at = {}, 0
    for channel in PLANT_CHANNELS:
        shape = (ticks, *channel.shape(n_legs))
        end = at + math.prod(shape)
        found[channel.name] = samples[at:end].reshape(shape)[:count]
        at = end
    return found
