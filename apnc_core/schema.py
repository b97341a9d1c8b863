"""What the table of variables says of a variable."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from apnc_core.enumerations import Enumeration

VR_STRIDE: Final = 100
"""Value reference = VR_STRIDE * number of the variable + element, for any number of legs."""

VR_TIME: Final = 9900
"""Value reference of the time, which FMI 3.0 lists as a variable; beyond all others."""

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
    """How many entries a variable has: one, one per leg, or one per phase relation phi_1k."""

    scalar = "scalar"
    leg = "leg"
    relation = "relation"


Value = float | int | bool
"""Value of one entry of a variable; an item of an enumeration is an int."""


@dataclass(frozen=True)
class Variable:
    """A variable of a model, with one entry or several.

    ``start`` is the default (preset ``lilibot``); ``paper`` is the printed constant where it
    differs (preset ``paper``). ``min`` and ``max`` are inclusive; the FMU refuses or limits what
    lies outside. ``initial_from`` names the parameters that determine the initial value of an
    output.
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
        index, flat = element + 1, naming == "flat"
        name = self.identifier if flat else self.name
        if self.shape is Shape.scalar:
            return name
        if self.shape is Shape.leg:
            return f"leg{index}_{name}" if flat else f"leg[{index}].{name}"
        return f"{name}{index}" if flat else f"{name}[{index}]"

    @property
    def identifier(self) -> str:
        """The name with underscores for points, as programming languages need it."""
        return self.name.replace(".", "_")


@dataclass(frozen=True)
class Scalar:
    """A scalar variable of FMI: one entry of a variable."""

    variable: Variable
    element: int
    value_reference: int
    name: str


def scalars_of(
    table: tuple[Variable, ...],
    numbers: Mapping[str, int],
    n_legs: int,
    naming: str = "structured",
) -> Iterator[Scalar]:
    """All scalar variables, in the order of the table; of each variable, leg after leg.

    Args:
        table: the variables.
        numbers: number of each variable, by its name.
        n_legs: number of legs, 2 to 64.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``).

    Raises:
        ValueError: number of legs or naming outside what is allowed.
    """
    if not 2 <= n_legs <= MAX_LEGS:
        raise ValueError(f"number of legs {n_legs} is not in 2 ... {MAX_LEGS}")
    if naming not in ("structured", "flat"):
        raise ValueError(f"naming '{naming}' is not structured or flat")
    for variable in table:
        first = VR_STRIDE * numbers[variable.name]
        for element in range(variable.count(n_legs)):
            name = variable.scalar_name(element, naming)
            yield Scalar(variable, element, first + element, name)
