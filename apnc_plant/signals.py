"""Signals that a plant delivers at every tick: names, units and signs, the same in all engines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

XYZ: Final = ("x", "y", "z")
ANGLES: Final = ("roll", "pitch", "yaw")
JOINT_SIGNS: Final = {
    "abduction": "moves the foot to the left",
    "hip": "swings the foot forward",
    "knee": "lifts the foot",
}
"""Effect of a positive angle of each joint."""

JOINTS: Final = tuple(JOINT_SIGNS)
WORLD: Final = "world: x forward at the start, y to the left, z up"


class PlantError(RuntimeError):
    """The motion diverged, or an engine refused the model."""


def diverged(time: float, step: float) -> str:
    """Message about a motion that diverged.

    Args:
        time: when it was noticed [s].
        step: longest integration step [s].
    """
    return f"the motion diverged before t = {time:.4f} s with integration steps of {step:.4g} s"


@dataclass(frozen=True)
class Signal:
    """One quantity over time.

    Args:
        name: name in samples and records.
        unit: unit.
        description: what the quantity is.
        frame: frame of its components; empty if it has none.
        per_leg: True: it has one entry per leg, in the order of the robot's legs.
        components: names of the entries of a vector; empty for a scalar.
        sign: meaning of a positive value; empty if the frame defines it.
    """

    name: str
    unit: str
    description: str
    frame: str = ""
    per_leg: bool = False
    components: tuple[str, ...] = ()
    sign: str = ""

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


_RPY: Final = "positive roll: right side down; pitch: nose down; yaw: to the left"
_SIGNS: Final = "; ".join(f"{joint}: {effect}" for joint, effect in JOINT_SIGNS.items())
_JOINT: Final = f"0 in the reference pose; positive {_SIGNS}"

PLANT_SIGNALS: Final[tuple[Signal, ...]] = (
    Signal("position", "m", "trunk reference point", WORLD, False, XYZ),
    Signal(
        "rpy",
        "rad",
        "roll, pitch and yaw of the trunk",
        "world to trunk: yaw about z, then pitch about y, then roll about x",
        False,
        ANGLES,
        _RPY,
    ),
    Signal("velocity", "m/s", "velocity of the trunk reference point", WORLD, False, XYZ),
    Signal("joint_angle", "rad", "angle of the joint", "joint", True, JOINTS, _JOINT),
    Signal("joint_speed", "rad/s", "speed of the joint", "joint", True, JOINTS, _JOINT),
    Signal("joint_torque", "N.m", "torque of the servo", "joint", True, JOINTS, _JOINT),
    Signal(
        "joint_work",
        "J",
        "|torque times speed| of the servo over time since the start",
        "joint",
        True,
        JOINTS,
        "never decreases",
    ),
    Signal("foot_position", "m", "centre of the foot ball", WORLD, True, XYZ),
    Signal("foot_force", "N", "force of the ground on the foot", WORLD, True, XYZ),
    Signal(
        "grf",
        "N",
        "load the foot sensor delivers to the controller",
        per_leg=True,
        sign="positive: the foot presses; never negative",
    ),
)
"""Every signal of a plant, in the order of a record."""
