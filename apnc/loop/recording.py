"""What one closed-loop run leaves behind: every channel, sampled once per control tick."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Channel:
    """One recorded quantity: its unit, what it is, and the columns it has per sample.

    ``per_leg`` channels have one entry per leg, in the order of ``Record.legs``;
    ``components`` names the entries of a vector (empty for a scalar).
    """

    name: str
    unit: str
    description: str
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
    Channel("joint_angle", "rad", "joint angle relative to the reference pose", True, JOINTS),
    Channel("joint_speed", "rad/s", "joint angular velocity", True, JOINTS),
    Channel("joint_torque", "N.m", "torque the servo applies to the joint", True, JOINTS),
    Channel("joint_work", "J", "|torque times speed| over time since the start", True, JOINTS),
    Channel("foot_position", "m", "centre of the foot ball, world frame", True, XYZ),
    Channel("foot_force", "N", "force of the ground on the foot, world frame", True, XYZ),
    Channel("grf", "N", "load the foot sensor delivers to the controller", True),
)


@dataclass(frozen=True)
class Record:
    """A finished or interrupted run.

    Args:
        legs: leg names in FMU order, e.g. ``("RF", "RH", "LF", "LH")``.
        time: sample times [s], shape (T,).
        plant: channel name -> array of shape (T, \\*channel.shape(n_legs)).
        controller: variable name of the FMU table -> array of shape (T,), (T, n_legs) for
            per-leg variables or (T, n_legs - 1) for phase relations (phi12, phi13, ...).
            Holds every output of the table (``o1``, ``o2``, ``theta_hip``, ``theta_knee``,
            ``gamma``, ``grf_expected``, ``f1``, ``f2``, ``g1``, ``g2``, ``fault``, ``phi``,
            ``phi_memory``, ``d``, ``kappa``) and the scalar inputs ``MI``, ``turn``, ``reset``.
        mass: total mass of the robot [kg].
        complete: False if the run ended before its planned end.
        error: why it ended early, if it was not asked to.
        fmu_wall_s: wall time spent inside the controller [s].
        wall_s: wall time of the whole loop [s].
    """

    legs: tuple[str, ...]
    time: Array
    plant: Mapping[str, Array]
    controller: Mapping[str, Array]
    mass: float
    complete: bool = True
    error: str = ""
    fmu_wall_s: float = 0.0
    wall_s: float = 0.0

    @property
    def n_legs(self) -> int:
        """Number of legs."""
        return len(self.legs)

    def __len__(self) -> int:
        return len(self.time)


def columns(record: Record) -> dict[str, Array]:
    """All channels as flat columns of shape (T,): ``time``, ``RF.o1``, ``phi12``, ``position.x``.

    Vectors are named by component, per-leg channels by leg, relations by the pair of legs.
    """
    table: dict[str, Array] = {"time": record.time}
    for name, values in record.controller.items():
        entries = values.reshape(len(record), -1)
        if values.ndim == 1:
            names = [name]
        elif values.shape[1] == record.n_legs:
            names = [f"{leg}.{name}" for leg in record.legs]
        else:
            names = [f"{name}1{k}" for k in range(2, record.n_legs + 1)]
        table |= dict(zip(names, entries.T, strict=True))
    for channel in PLANT_CHANNELS:
        entries = record.plant[channel.name].reshape(len(record), -1)
        names = channel.columns(record.legs)
        table |= dict(zip(names, entries.T, strict=True))
    return table


def write_csv(record: Record, path: Path) -> None:
    """Write every channel as one CSV file, a row per sample, SI units throughout.

    Raises:
        OSError: the file cannot be written.
    """
    table = columns(record)
    np.savetxt(
        path,
        np.column_stack(list(table.values())),
        fmt="%.9g",
        delimiter=",",
        header=",".join(table),
        comments="",
        encoding="utf-8",
    )
