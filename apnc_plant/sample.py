"""Records of the plant in C, split into channels by name."""

from __future__ import annotations

import math
from typing import Final

from apnc_plant.channels import PLANT_CHANNELS, XYZ
from apnc_plant.robot.model import Array

_IN_C: Final = ("position", "rpy", "velocity", "joint_angle", "joint_speed", "joint_torque",
                "joint_work", "foot_position", "foot_force", "grf")  # fmt: skip
"""Channels in the order of ``plant_sample``."""

_SHAPES: Final = {channel.name: channel.shape for channel in PLANT_CHANNELS}


def sample_size(n_legs: int) -> int:
    """Numbers in a sample; the C function ``plant_sample_size`` says the same."""
    return 3 * len(XYZ) + 19 * n_legs


def channels_of(samples: Array, ticks: int, count: int, n_legs: int) -> dict[str, Array]:
    """The channels of a record that C wrote, as views into it.

    Args:
        samples: the channels one after the other, each of ``ticks`` times its size, shape (any,).
        ticks: samples there is room for.
        count: samples that were taken.
        n_legs: number of legs.

    Returns:
        Every channel of ``PLANT_CHANNELS``, samples along the first axis.
    """
    channels, start = {}, 0
    for name in _IN_C:
        shape = (ticks, *_SHAPES[name](n_legs))
        size = math.prod(shape)
        channels[name] = samples[start : start + size].reshape(shape)[:count]
        start += size
    return channels
