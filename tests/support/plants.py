"""The plants that must walk alike: in plain C, and the reference in Exudyn."""

from __future__ import annotations

import numpy as np
import pytest

from apnc_plant.compiled import CompiledPlant
from apnc_plant.ground import Ground
from apnc_plant.robot import RobotDescription
from exudyn_models.plant import ExudynPlant

AnyPlant = CompiledPlant | ExudynPlant
Kind = type[CompiledPlant] | type[ExudynPlant]

in_both = pytest.mark.parametrize("kind", [CompiledPlant, ExudynPlant], ids=["compiled", "exudyn"])


def settled(kind: Kind, ground: Ground, robot: RobotDescription) -> AnyPlant:
    """A robot of four legs after two seconds of standing on a ground."""
    plant = kind(robot, ground=ground)
    for _ in range(120):
        plant.advance(np.zeros(4), np.zeros(4), 1 / 60)
    return plant
