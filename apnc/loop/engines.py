"""Engines by name. A package is imported only when its engine is used."""

from __future__ import annotations

import importlib
import importlib.util
from typing import TYPE_CHECKING, Final

from apnc.extras import missing

if TYPE_CHECKING:
    from apnc_plant.compiled import CompiledPlant
    from apnc_plant.legged import LeggedPlant

COMPILED: Final = "compiled"
"""The robot in plain C."""

ENGINES: Final = {
    "exudyn": ("exudyn_models.plant", "ExudynPlant"),
    "mujoco": ("mujoco_models.plant", "MujocoPlant"),
    COMPILED: ("apnc_plant.compiled", "CompiledPlant"),
}
"""Module and class of the plant in each engine."""

OWN_ENGINE: Final = "exudyn"
"""The engine if none is named."""


EXTRAS: Final = ("mujoco",)
"""Engines whose package is installed by an extra of the same name."""


def check_engine(name: str) -> None:
    """Refuse an unknown engine.

    Raises:
        ValueError: an unknown name.
    """
    if name not in ENGINES:
        raise ValueError(f"engine '{name}' is not one of {', '.join(ENGINES)}")


def plant_in(engine: str) -> type[LeggedPlant | CompiledPlant]:
    """Class of the plant in an engine.

    Raises:
        ValueError: the engine's package is not installed.
    """
    if engine in EXTRAS and importlib.util.find_spec(engine) is None:
        raise ValueError(missing(engine, engine))
    module, name = ENGINES[engine]
    plant: type[LeggedPlant | CompiledPlant] = getattr(importlib.import_module(module), name)
    return plant
