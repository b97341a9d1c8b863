"""Grounds: one object each, which nothing else needs to know the kind of."""

from apnc_plant.ground.in_c import GroundInC, Numbers
from apnc_plant.ground.kerb import Kerb
from apnc_plant.ground.obstacles import Ground
from apnc_plant.ground.plane import Plane
from apnc_plant.ground.surface import GROUNDS, Surface, from_dict, surface
from apnc_plant.ground.waves import Waves

GROUNDS.update({ground.kind: ground for ground in (Plane, Ground, Kerb, Waves)})

__all__ = [
    "GROUNDS",
    "Ground",
    "GroundInC",
    "Kerb",
    "Numbers",
    "Plane",
    "Surface",
    "Waves",
    "from_dict",
    "surface",
]
