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


def commands(tick: int, legs: int = 4, knee: float = 0.08) -> tuple[np.ndarray, np.ndarray]:
    """Hip and knee commands [rad] of a trot, or tripod, on fixed phases that walks forward.

    ``knee`` is the amplitude of the knees [rad].
    """
    side = (-1.0) ** np.arange(legs // 2)
    side, phase = np.concatenate([side, -side]), 0.12 * tick
    return 0.13 * np.sin(phase) * side - 0.111, knee * np.cos(phase) * side - 0.039


def trot(plant: AnyPlant, tick: int, duration: float = 1 / 60) -> None:
    """Walk a plant through a tick of the trot, or a part of it."""
    plant.advance(*commands(tick, plant.n_legs), duration)


def stand(kind: Kind, robot: RobotDescription, seconds: float = 2.0) -> AnyPlant:
    """A robot that has stood on the level ground for a time."""
    return _still(kind(robot), seconds)


def _still(plant: AnyPlant, seconds: float) -> AnyPlant:
    for _ in range(round(seconds * 60)):
        plant.advance(np.zeros(plant.n_legs), np.zeros(plant.n_legs), 1 / 60)
    return plant


def settled(kind: Kind, ground: Ground, robot: RobotDescription) -> AnyPlant:
    """A robot after two seconds of standing on a ground."""
    return _still(kind(robot, ground=ground), 2.0)
