"""The plants that must walk alike: in plain C, and the reference in Exudyn."""

from __future__ import annotations

import pytest

from apnc_plant.compiled import Plant as CompiledPlant
from exudyn_models.plant import Plant as ExudynPlant

AnyPlant = CompiledPlant | ExudynPlant
Kind = type[CompiledPlant] | type[ExudynPlant]

in_both = pytest.mark.parametrize("kind", [CompiledPlant, ExudynPlant], ids=["compiled", "exudyn"])
