"""A field of sine waves."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.ground.ground import Ground
from apnc_plant.ground.in_c import Numbers

STEEPEST: Final = 1.0
"""Largest slope along x or y [1]; 1 is 45 degrees."""

TIGHTEST: Final = 0.5
"""Largest radius of a ball over the smallest radius of curvature [1], for one contact point."""


@dataclass(frozen=True)
class Waves(Ground):
    """z = amplitude / 2 (sin(k x) + sin(k y)) with k = 2 pi / wavelength, in all directions.

    Args:
        slope: angle by which the whole ground rises along x [rad].
        amplitude: largest height over the plane, and largest depth below it [m].
        wavelength: wavelength of both waves [m].

    Raises:
        ValueError: a value out of range, or waves steeper than 45 degrees.

    A ball touches at the point of the surface nearest to its centre. Newton's method finds it to
    1e-9 m; the depth is then exact to 1e-15 m, because the distance has its minimum there. The
    nearest point is unique only if the valleys are wide, so a ball of more than half their radius
    of curvature is refused.
    """

    kind: ClassVar[str] = "waves"
    kind_in_c: ClassVar[str] = "PLANT_WAVES"

    amplitude: float = 0.005
    wavelength: float = 0.4

    def __post_init__(self) -> None:
        """Check the values."""
        super().__post_init__()
        self._require("wavelength", 0.0 < self.wavelength < math.inf, "above 0 [m]")
        steepest = STEEPEST * 2.0 / self._wavenumber
        allowed = f"from 0 to {steepest:.4g} at this wavelength [m]"
        self._require("amplitude", 0.0 <= self.amplitude <= steepest, allowed)

    @property
    def _wavenumber(self) -> float:
        return 2.0 * math.pi / self.wavelength

    @property
    def top(self) -> float:
        """Height of the crests [m]."""
        return self.amplitude

    def elevation(self, x: Array, y: Array) -> Array:
        """Height of the waves [m]."""
        k = self._wavenumber
        return np.asarray(self.amplitude / 2.0 * (np.sin(k * x) + np.sin(k * y)))

    def numbers(self, radius: float) -> Numbers:
        """Half the amplitude [m] and the wavenumber [rad/m].

        Raises:
            ValueError: the ball is too large for the valleys.
        """
        curvature = self.amplitude / 2.0 * self._wavenumber**2
        if radius * curvature > TIGHTEST:
            raise ValueError(
                f"amplitude is {self.amplitude}; allowed: up to "
                f"{2.0 * TIGHTEST / (radius * self._wavenumber**2):.4g} "
                f"at this wavelength and a ball of radius {radius} [m]"
            )
        return Numbers(np.array([self.amplitude / 2.0, self._wavenumber]), contacts=1)
