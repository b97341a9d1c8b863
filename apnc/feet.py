"""Strides and feet of a run, or of a part of it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc_core.types import Array

if TYPE_CHECKING:
    from apnc.loop.record import Record

ByLeg = Sequence[float | None]
"""A measure of each leg, in the order of ``Record.legs``; None for a leg where it is undefined."""


class Feet:
    """Measures of strides and feet, each computed when it is first asked for.

    Strides begin in the part. Stance is what it is in the whole run, since its threshold is a share
    of a high quantile of the force of leg 1 in the run, see ``metrics.stance``.

    Args:
        record: the run.
        part: the samples that count.
    """

    def __init__(self, record: Record, part: slice = slice(None)) -> None:
        self._record, self._part = record, part

    @cached_property
    def standing(self) -> NDArray[np.bool_]:
        """Which feet stand, shape (T, n) for the T samples of the part."""
        return metrics.stance(self._record.signals["foot_force"][..., 2])[self._part]

    @cached_property
    def starts(self) -> list[Array]:
        """When the cycles of each oscillator begin [samples of the part], an array per leg."""
        o1, o2 = (self._record.signals[name][self._part] for name in ("o1", "o2"))
        return metrics.cycle_starts(o1, o2)

    @cached_property
    def stride_frequency(self) -> float | None:
        """Cycles of the oscillators in a second [Hz], mean over the legs."""
        return metrics.stride_frequency(self.starts, 1.0 / self._record.experiment.rate)

    @cached_property
    def stride_length(self) -> float | None:
        """Way of the trunk along its path in a stride [m]."""
        way = metrics.path_length(self._record.signals["position"][self._part])
        speed = metrics.mean_speed(self._record.time[self._part], way)
        return metrics.stride_length(speed, self.stride_frequency)

    @cached_property
    def duty_factors(self) -> ByLeg:
        """Mean share of stance in a stride [1]."""
        return metrics.duty_factors(self.standing, self.starts)

    @cached_property
    def touch_downs(self) -> ByLeg:
        """Mean number of touch-downs in a stride [1]; more than one if the foot scuffs."""
        return metrics.touch_downs_per_stride(self.standing, self.starts)

    @cached_property
    def lifts(self) -> ByLeg:
        """Height of the foot in mid-swing above its mean height in stance [m]."""
        return metrics.foot_lifts(self._positions, self.standing, self.starts)

    @cached_property
    def slips(self) -> ByLeg:
        """Horizontal way of the foot in the stance of a stride [m]."""
        return metrics.slips(self._positions, self.standing, self.starts)

    def coordination(self, speed: float | None) -> float | None:
        """One over the largest spread of the share of stance of any leg [1]; larger is more even.

        Args:
            speed: along the path [m/s]; a robot that stands has no coordination.
        """
        return metrics.coordination(self.standing, self.starts, speed)

    @property
    def _positions(self) -> Array:
        return self._record.signals["foot_position"][self._part]
