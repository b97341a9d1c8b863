"""Samples of the plant in C: rows of numbers, split into channels by name."""

from __future__ import annotations

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


def channels_of(rows: Array, n_legs: int) -> dict[str, Array]:
    """Views of samples by channel.

    Args:
        rows: samples as ``plant_sample`` writes them, shape (ticks, 9 + 19 n_legs).
        n_legs: number of legs.

    Returns:
        Every channel of ``PLANT_CHANNELS``, ticks along the first axis.
    """
    channels, start = {}, 0
    for name in _IN_C:
        shape = _SHAPES[name](n_legs)
        size = 1
        for length in shape:
            size *= length
        channels[name] = rows[:, start : start + size].reshape(len(rows), *shape)
        start += size
    return channels
