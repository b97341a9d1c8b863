"""Samples of a walk as the live page reads them: numbers in a row, 64 bits each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from apnc.metrics.strides import STANCE_SHARE
from apnc.report.animation import still_parts
from apnc_core.types import Array
from apnc_plant.robot import RobotDescription

SIGNALS: Final = ("position", "rpy", "joint_angle", "foot_position", "foot_force")
"""Signals of the plant that the page draws."""


@dataclass(frozen=True, eq=False)
class Sample:
    """One moment.

    Args:
        t: time [s].
        plant: the plant's signals.
        focus: what the camera looks at [m], shape (3,).
        phi: relative phases [rad], shape (n_legs - 1,).
    """

    t: float
    plant: Mapping[str, Array]
    focus: Array
    phi: Array


STANDS: Final = 0.5 * STANCE_SHARE
"""Load from which a foot stands, as a share of the weight.

In the report it is a share of the largest load of leg 1, which in a trot is near half the weight.
"""


def rows_of(robot: RobotDescription, samples: Sequence[Sample]) -> Array:
    """Rows of numbers, shape (T, 9 + 14 n), of at least one sample.

    A row is the time (1) [s]; position (3) [m], roll, pitch and yaw (3) [rad] and focus (3) [m] in
    the world; second hip joint, knee and foot of every leg (9 n) [m] in the frame of the trunk;
    force of the ground on every foot (3 n) [N] in the world; 1 for every foot that stands (n), and
    the relative phases (n - 1) [rad].
    """
    count = len(samples)
    plant = {name: np.stack([sample.plant[name] for sample in samples]) for name in SIGNALS}
    parts = [
        np.array([sample.t for sample in samples]),
        plant["position"],
        plant["rpy"],
        np.stack([sample.focus for sample in samples]),
        still_parts(robot, plant)[1][:, :, 1:],
        plant["foot_force"],
        plant["foot_force"][..., 2] > STANDS * robot.weight,
        np.stack([sample.phi for sample in samples]),
    ]
    return np.concatenate([np.reshape(part, (count, -1)) for part in parts], axis=1)


def thinned(samples: Sequence[Sample], most: int) -> Sequence[Sample]:
    """At most so many of the samples, evenly chosen; the last one stays."""
    step = -(-len(samples) // most)
    return samples[::-1][::step][::-1] if step > 1 else samples
