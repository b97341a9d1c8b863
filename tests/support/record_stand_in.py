"""Stand-ins for ``apnc.loop.experiment`` and ``apnc.loop.record`` until these are there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray


class End(StrEnum):
    complete = "complete"
    fell = "fell"
    diverged = "diverged"
    interrupted = "interrupted"


@dataclass(frozen=True)
class Experiment:
    robot: str = "lilibot"
    mi: Any = 0.08
    duration: float = 45.0
    seed: int = 0
    method: str = "apnc"
    rate: float = 60.0


@dataclass(frozen=True)
class Record:
    legs: tuple[str, ...]
    time: NDArray[np.float64]
    plant: Mapping[str, NDArray[np.float64]]
    controller: Mapping[str, NDArray[np.float64]]
    mass: float
    experiment: Experiment
    robot: Any
    end: End = End.complete
    message: str = ""
    fmu_wall_s: float = 0.0
    wall_s: float = 0.0

    def __len__(self) -> int:
        return len(self.time)

    @property
    def n_legs(self) -> int:
        return len(self.legs)

    @property
    def complete(self) -> bool:
        return self.end is End.complete

    @property
    def ended_at(self) -> float:
        return round(len(self) / self.experiment.rate, 9)
