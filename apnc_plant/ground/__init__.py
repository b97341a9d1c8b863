"""Grounds. Code outside this folder uses them without knowing their kind."""

from apnc_plant.ground.ground import GROUNDS, Ground, from_dict, parse_ground
from apnc_plant.ground.in_c import GroundInC, Numbers
from apnc_plant.ground.kerb import Kerb
from apnc_plant.ground.obstacles import Obstacles
from apnc_plant.ground.plane import Plane
from apnc_plant.ground.waves import Waves

GROUNDS.update({ground.kind: ground for ground in (Plane, Obstacles, Kerb, Waves)})

__all__ = [
    "GROUNDS",
    "Ground",
    "GroundInC",
    "Kerb",
    "Numbers",
    "Obstacles",
    "Plane",
    "Waves",
    "from_dict",
    "parse_ground",
]
