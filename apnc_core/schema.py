"""What a row of the table of variables can say."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from apnc_core.enumerations import Enumeration

VR_STRIDE: Final = 100
"""Value reference = VR_STRIDE * number of the row + element, the same for any number of legs."""

VR_TIME: Final = 9900
"""Value reference of the independent variable, which FMI 3.0 wants; beyond all rows."""

MAX_LEGS: Final = 64


class Type(StrEnum):
    """FMI base type."""

    real = "Real"
    integer = "Integer"
    boolean = "Boolean"
    enumeration = "Enumeration"


class Causality(StrEnum):
    """FMI causality."""

    input = "input"
    output = "output"
    local = "local"
    parameter = "parameter"


class Shape(StrEnum):
    """How many entries a row has: one, one per leg, or one per phase relation phi_1k."""

    scalar = "scalar"
    leg = "leg"
    relation = "relation"


Value = float | int | bool


@dataclass(frozen=True)
class Variable:
    """One row of the table.

    ``start`` is the default (preset ``lilibot``); ``paper`` is the printed constant where it
    differs (preset ``paper``). ``min`` and ``max`` are inclusive and enforced.
    ``initial_from`` names the parameters that the initial value of an output follows from.
    """

    name: str
    symbol: str
    description: str
    causality: Causality
    variability: str
    type: Type = Type.real
    shape: Shape = Shape.scalar
    start: Value | None = None
    paper: Value | None = None
    unit: str | None = None
    display_unit: str | None = None
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    equation: str = ""
    source: str = ""
    enumeration: Enumeration | None = None
    initial_from: tuple[str, ...] = ()

    def count(self, n_legs: int) -> int:
        """Number of scalar entries for ``n_legs`` legs."""
        return {Shape.scalar: 1, Shape.leg: n_legs, Shape.relation: n_legs - 1}[self.shape]

    def scalar_name(self, element: int, naming: str = "structured") -> str:
        """FMI name of entry ``element`` (from 0): ``leg[1].grf``, or ``leg1_grf`` when flat."""
        index = element + 1
        if self.shape is Shape.scalar:
            return self.name
        if self.shape is Shape.leg:
            return (
                f"leg[{index}].{self.name}" if naming == "structured" else f"leg{index}_{self.name}"
            )
        return f"{self.name}[{index}]" if naming == "structured" else f"{self.name}{index}"
