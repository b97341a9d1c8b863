"""Grounds: one object each, which nothing else needs to know the kind of."""

from exudyn_models.ground.kerb import Kerb
from exudyn_models.ground.obstacles import Ground
from exudyn_models.ground.plane import Plane
from exudyn_models.ground.surface import GROUNDS, Numbers, Surface, from_dict, surface
from exudyn_models.ground.waves import Waves

GROUNDS.update({ground.kind: ground for ground in (Plane, Ground, Kerb, Waves)})

__all__ = [
    "GROUNDS",
    "Ground",
    "Kerb",
    "Numbers",
    "Plane",
    "Surface",
    "Waves",
    "from_dict",
    "surface",
]
