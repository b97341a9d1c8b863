"""The plants that must walk alike: in plain C, and the reference in Exudyn."""

from __future__ import annotations

import numpy as np
import pytest

from apnc_plant.compiled import CompiledPlant
from apnc_plant.ground import Ground
from apnc_plant.robot import load_robot
from exudyn_models.plant import ExudynPlant

AnyPlant = CompiledPlant | ExudynPlant
Kind = type[CompiledPlant] | type[ExudynPlant]

in_both = pytest.mark.parametrize("kind", [CompiledPlant, ExudynPlant], ids=["compiled", "exudyn"])


def settled(kind: Kind, ground: Ground) -> AnyPlant:
    """Lilibot after two seconds of standing on a ground."""
    plant = kind(load_robot("lilibot"), ground=ground)
    for _ in range(120):
        plant.advance(np.zeros(4), np.zeros(4), 1 / 60)
    return plant
