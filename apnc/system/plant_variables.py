"""The interface of the plant FMU, made from the table of variables and the channels of a plant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from apnc_core.schema import Causality, Value
from apnc_core.variables import row
from apnc_plant.channels import PLANT_CHANNELS
from apnc_plant.conditions import CONDITIONS
from build_fmu.description_parts import UNITS as CONTROLLER_UNITS

NAMINGS: Final = ("structured", "flat")

UNITS: Final = CONTROLLER_UNITS | {
    "kg": {"kg": "1"},
    "m": {"m": "1"},
    "m/s": {"m": "1", "s": "-1"},
    "rad/s": {"rad": "1", "s": "-1"},
    "N.m": {"kg": "1", "m": "2", "s": "-2"},
    "J": {"kg": "1", "m": "2", "s": "-2"},
}
"""Units of the interface by exponents of the base units."""

COMMANDS: Final = ("theta_hip", "theta_knee")
LOAD: Final = "grf"
LARGEST_SEED: Final = 2**31 - 1


@dataclass(frozen=True)
class PlantVariable:
    """One scalar variable.

    Args:
        name: its name in the FMU.
        causality: input, output or parameter.
        description: what it is.
        unit: its unit; ``None`` if it is no Real.
        start: start value of an input or a parameter; its type is that of the variable.
        low, high: limits of a parameter.
        tunable: whether a parameter can be set between two steps.
    """

    name: str
    causality: Causality
    description: str
    unit: str | None = None
    start: Value | str | None = None
    low: float | None = None
    high: float | None = None
    tunable: bool = False

    @property
    def type(self) -> str:
        """Its type in FMI: that of its start value, Real with a unit, Boolean without either."""
        if self.unit:
            return "Real"
        return {int: "Integer", str: "String"}.get(type(self.start), "Boolean")


def plant_variables(n_legs: int, naming: str = "structured") -> list[PlantVariable]:
    """Inputs, parameters and outputs, in the order of their value references.

    Args:
        n_legs: number of legs.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``), as the controller's.

    Raises:
        ValueError: another naming.
    """
    if naming not in NAMINGS:
        raise ValueError(f"naming '{naming}' is not one of {', '.join(NAMINGS)}")
    return [*_inputs(n_legs, naming), *PARAMETERS, *_outputs(n_legs, naming), FELL]


def _inputs(n_legs: int, naming: str) -> list[PlantVariable]:
    return [
        PlantVariable(c.scalar_name(leg, naming), Causality.input, c.description, c.unit, 0.0)
        for c in map(row, COMMANDS)
        for leg in range(n_legs)
    ]


_SET: Final = Causality.parameter

PARAMETERS: Final = (
    PlantVariable(
        "seed", _SET, "chooses the asymmetry of the robot, the noise of its sensors and the "
        "obstacles", None, 0, 0, LARGEST_SEED),
    PlantVariable(
        "roughness", _SET, "height of the obstacles on the ground over the robot's step height; "
        "0 for none", "1", 0.0, 0.0, 1.0),
    PlantVariable(
        "slope", _SET, "angle by which the ground rises along x", "rad", 0.0, -1.5, 1.5),
    PlantVariable(
        "payload", _SET, "mass of a box on the trunk, on top of that of the condition",
        "kg", 0.0, 0.0, 100.0),
    PlantVariable(
        "condition", _SET, f"what is wrong with the robot: {', '.join(CONDITIONS)}",
        start="C1", tunable=True),
)  # fmt: skip

FELL: Final = PlantVariable(
    "fell",
    Causality.output,
    "true once the trunk has tipped by more than 60 degrees or touched the ground; nothing moves "
    "from then on",
)


def _outputs(n_legs: int, naming: str) -> list[PlantVariable]:
    stem, point = ("leg[{}]", ".") if naming == "structured" else ("leg{}", "_")
    legs = tuple(stem.format(i) for i in range(1, n_legs + 1))
    return [
        PlantVariable(
            column.replace(".", point),
            Causality.output,
            "; ".join(filter(None, (channel.description, channel.frame, channel.sign))),
            channel.unit,
        )
        for channel in PLANT_CHANNELS
        for column in channel.columns(legs)
    ]
