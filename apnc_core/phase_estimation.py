"""Decides from the relative phases whether they have settled (Eq. 13-16)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from apnc_core.elementary import total, wrap
from apnc_core.enumerations import KappaRule
from apnc_core.interface import Parameters
from apnc_core.types import Array


@dataclass
class Stability:
    """Distance d(n) of the relative phases from the mean of the N before them."""

    n_legs: int
    N: int
    angle_before: Array = field(init=False)
    unwrapped: Array = field(init=False)
    window: Array = field(init=False)

    def __post_init__(self) -> None:
        """Start as if the phases had always been zero."""
        self.angle_before = np.zeros(self.n_legs - 1)
        self.unwrapped = np.zeros(self.n_legs - 1)
        self.window = np.zeros((self.N, self.n_legs - 1))

    def update(self, angle: Array) -> float:
        """Distance d(n) [rad] for the angles at n [rad], shape (n - 1,).

        d(n) = |Phi(n) - mean(Phi(n-1) ... Phi(n-N))| (Eq. 13-15). Pitfall: all phases start at
        zero, so d is zero from the first tick, long before there is a gait.
        """
        self.unwrapped = self.unwrapped + wrap(angle - self.angle_before)
        self.angle_before = angle
        deviation = self.unwrapped - self.window.mean(axis=0)
        self.window = np.vstack([self.window[1:], self.unwrapped])
        return math.sqrt(total(deviation * deviation))


@dataclass
class Switch:
    """Decides when the relations count as settled, kappa(n)."""

    armed: bool = False
    calm: int = 0

    def settled(self, d: float, p: Parameters) -> bool:
        """Whether kappa may switch on at this tick.

        Args:
            d: distance of the phases from their mean [rad].
            p: uses ``kappa_rule``, ``sigma`` [rad], ``kappa_hold`` [ticks].

        Rule ``printed``: d <= sigma (Eq. 16). Rule ``armed``: d has exceeded sigma once and has
        then stayed at or below it for ``kappa_hold`` ticks.
        """
        below = d <= p.sigma
        self.armed = self.armed or not below
        self.calm = self.calm + 1 if self.armed and below else 0
        return below if p.kappa_rule == KappaRule.printed else self.calm >= p.kappa_hold
