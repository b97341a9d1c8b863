"""Interface of a plant; an engine or another FMU can implement it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from apnc_core.types import Array
from apnc_plant.conditions import Conditions
from apnc_plant.signals import PlantError
from apnc_plant.trace import Trace

__all__ = ["Plant", "PlantError"]


class Plant(Protocol):
    """A robot on a ground, ready to be stepped; ``apnc_plant.compiled.CompiledPlant`` is one."""

    @property
    def legs(self) -> tuple[str, ...]:
        """Names of the legs in FMU order."""

    @property
    def mass(self) -> float:
        """Total mass with payload [kg]."""

    @property
    def fell(self) -> bool:
        """Whether the robot has fallen."""

    def grf(self) -> Array:
        """Load of each foot as its sensor delivers it now [N], shape (n_legs,)."""

    def set_conditions(self, conditions: Conditions) -> None:
        """Set the conditions that hold from now on."""

    def advance(self, theta_hip: Array, theta_knee: Array, duration: float) -> None:
        """Follow joint commands [rad], shape (n_legs,), for a time [s].

        Raises:
            PlantError: the motion diverged.
        """

    def trace(self) -> Trace:
        """A recorder of every signal in ``apnc_plant.signals.PLANT_SIGNALS``."""


@runtime_checkable
class LivePlant(Plant, Protocol):
    """A plant that can be watched and pushed while it walks."""

    def sample(self) -> dict[str, Array]:
        """One sample of every signal in ``PLANT_SIGNALS``, at the current time."""

    def shift_velocity(self, x: float, y: float) -> None:
        """Change the velocity of the whole robot along x and y of the world at once [m/s]."""
