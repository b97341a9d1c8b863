"""Acquisition of the phase relations phi_12, phi_13, ... (Eq. 12).

phi_lk is positive when leg k leads leg l. The mean of Eq. 14 needs phases without jumps:
``phase_estimation`` unwraps the angles that both measures give.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from apnc_core.elementary import angle_of, wrap_far
from apnc_core.interface import Parameters
from apnc_core.types import Array


@dataclass
class VectorMeasure:
    """Angle between the vectors (o1, o2) of leg 1 and of leg k, low-pass filtered.

    The filter acts on the complex products, not on their angles. The cycle is not a circle, so the
    angle oscillates within a period, and an angle cannot be averaged where it wraps.
    """

    n_legs: int
    re: Array = field(init=False)
    im: Array = field(init=False)

    def __post_init__(self) -> None:
        """Start with no history."""
        self.re = np.zeros(self.n_legs - 1)
        self.im = np.zeros(self.n_legs - 1)

    def update(self, o1: Array, o2: Array, p: Parameters) -> Array:
        """Angles of the relations in [-pi, pi], shape (n - 1,), from o(n), shape (n,) each."""
        re = o1[0] * o1[1:] + o2[0] * o2[1:]
        im = o2[0] * o1[1:] - o1[0] * o2[1:]
        self.re = self.re + p.phase_filter * (re - self.re)
        self.im = self.im + p.phase_filter * (im - self.im)
        return angle_of(self.im, self.re)


@dataclass
class PeakMeasure:
    """Times between the peaks of o1 over the period of leg 1, as the paper prints it.

    phi_1k = 2 pi (t_p^1 - t_p^k) / T (Eq. 12). Zero until leg 1 has shown two peaks and leg k
    one. Pitfall: resolves 2 pi / (ticks per period), 0.15 rad at 1.4 Hz and 60 Hz.
    """

    n_legs: int
    o1_before: Array = field(init=False)
    o1_before2: Array = field(init=False)
    t_peak: Array = field(init=False)
    period: float = 0.0
    now: float = 0.0

    def __post_init__(self) -> None:
        """Start with no peak seen (times are negative)."""
        self.o1_before = np.full(self.n_legs, math.inf)
        self.o1_before2 = np.full(self.n_legs, math.inf)
        self.t_peak = np.full(self.n_legs, -1.0)

    def update(self, o1: Array, o2: Array, p: Parameters) -> Array:
        """Angles of the relations in [-pi, pi), shape (n - 1,), from o(n), shape (n,) each."""
        peaked = (self.o1_before2 < self.o1_before) & (self.o1_before >= o1)
        t = self.now - 1.0
        if peaked[0] and self.t_peak[0] >= 0.0:
            self.period = t - float(self.t_peak[0])
        self.t_peak = np.where(peaked, t, self.t_peak)
        self.o1_before2, self.o1_before = self.o1_before, o1
        self.now += 1.0
        known = (self.period > 0.0) & (self.t_peak[1:] >= 0.0)
        lag = np.where(known, (self.t_peak[0] - self.t_peak[1:]) / (self.period or 1.0), 0.0)
        return wrap_far(2.0 * math.pi * lag)
