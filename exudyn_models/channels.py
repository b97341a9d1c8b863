"""What every plant shows: channels sampled once per tick."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final


class PlantError(RuntimeError):
    """The motion broke down."""


@dataclass(frozen=True)
class Channel:
    """One recorded quantity: its unit, what it is, and the columns it has per sample.

    ``per_leg`` channels have one entry per leg, in the order of ``Record.legs``;
    ``components`` names the entries of a vector (empty for a scalar).
    """

    name: str
    unit: str
    description: str
    frame: str = ""
    per_leg: bool = False
    components: tuple[str, ...] = ()

    def shape(self, n_legs: int) -> tuple[int, ...]:
        """Shape of one sample for a robot with ``n_legs`` legs."""
        legs = (n_legs,) if self.per_leg else ()
        return legs + ((len(self.components),) if self.components else ())

    def columns(self, legs: tuple[str, ...]) -> list[str]:
        """Flat column names, in the memory order of one sample."""
        stems = [f"{leg}.{self.name}" for leg in legs] if self.per_leg else [self.name]
        if not self.components:
            return stems
        return [f"{stem}.{component}" for stem in stems for component in self.components]


XYZ: Final = ("x", "y", "z")
JOINTS: Final = ("abduction", "hip", "knee")

PLANT_CHANNELS: Final[tuple[Channel, ...]] = (
    Channel("position", "m", "trunk reference point in the world frame", components=XYZ),
    Channel("rpy", "rad", "trunk roll, pitch, yaw", components=("roll", "pitch", "yaw")),
    Channel("velocity", "m/s", "trunk reference point velocity, world frame", components=XYZ),
    Channel("joint_angle", "rad", "joint angle relative to the reference pose", "", True, JOINTS),
    Channel("joint_speed", "rad/s", "joint angular velocity", "", True, JOINTS),
    Channel("joint_torque", "N.m", "torque the servo applies to the joint", "", True, JOINTS),
    Channel("joint_work", "J", "|torque times speed| over time since the start", "", True, JOINTS),
    Channel("foot_position", "m", "centre of the foot ball, world frame", "", True, XYZ),
    Channel("foot_force", "N", "force of the ground on the foot, world frame", "", True, XYZ),
    Channel("grf", "N", "load the foot sensor delivers to the controller", "", True),
)
