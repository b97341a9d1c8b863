"""Grounds of every kind, for tests of what holds on all of them."""

from typing import Final

from apnc_plant.ground import Ground, Kerb, Obstacles, Plane, Waves

TOUCHED: Final[tuple[Ground, ...]] = (
    Plane(slope=0.1),
    Obstacles(roughness=0.8, seed=5),
    Kerb(at=0.1, height=0.008, length=0.05),
    Kerb(at=-0.05, height=0.006),
    Waves(amplitude=0.004, wavelength=0.2),
)
"""What is uneven lies within 0.3 m of the origin."""

WALKED: Final[tuple[Ground, ...]] = (
    Plane(),
    Plane(slope=0.1),
    Obstacles(roughness=0.5, seed=3),
    Kerb(at=0.2, height=0.006, length=0.2),
    Waves(),
)
"""Every robot that ships walks over what is uneven in ten seconds, and does not fall."""
