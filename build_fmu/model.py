"""A model from which the description and the documentation of its FMU are made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, NamedTuple

from apnc_core.enumerations import Enumeration
from apnc_core.schema import (
    VR_STRIDE,
    Causality,
    Scalar,
    Shape,
    Type,
    Value,
    Variable,
    scalars_of,
)
from build_fmu.platforms import BuildError

FMI_VERSIONS: Final = (2, 3)
NAMINGS: Final = ("structured", "flat")
ENUMERATIONS_AS: Final = ("enumeration", "integer")


class RealType(NamedTuple):
    """A declared type of real numbers.

    Args:
        name: of the type.
        description: of its numbers.
        quantity: physical quantity; empty if there is none.
    """

    name: str
    description: str
    quantity: str


@dataclass(frozen=True)
class Model:
    """A model of an FMU.

    Args:
        identifier: name of the model and of its libraries.
        about: description of the model in one line.
        table: variables.
        numbers: number of each variable by name, from which value references follow.
        legs: names of the legs.
        starts: start values, one per entry, of variables that do not start as the table says.
        enumerations: enumeration types of the variables.
        types: type of real numbers by unit.
        log_categories: description of each log category.
        step: communication step of the default experiment [s].
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``). In FMI 3.0 the first
            shows arrays and the second a scalar per entry.
        fmi: version of the standard, 2 or 3.
        enumerations_as: ``enumeration``, or ``integer`` for importers that drop enumerations.
        reals: whether every variable is shown as a Real, for importers that read all of them so.

    Raises:
        BuildError: naming, version or form of enumerations outside what is allowed.
    """

    identifier: str
    about: str
    table: tuple[Variable, ...]
    numbers: Mapping[str, int]
    legs: tuple[str, ...]
    starts: Mapping[str, tuple[Value, ...]]
    enumerations: tuple[Enumeration, ...]
    types: Mapping[str, RealType]
    log_categories: Mapping[str, str]
    step: float
    naming: str = "structured"
    fmi: int = 2
    enumerations_as: str = "enumeration"
    reals: bool = False

    def __post_init__(self) -> None:
        """Check the choices."""
        check_choices(self.naming, self.fmi, self.enumerations_as)

    def scalars(self) -> list[Scalar]:
        """All scalar variables, in the order of the table."""
        return list(scalars_of(self.table, self.numbers, len(self.legs), self.naming))

    def variables_of(self, causality: Causality) -> tuple[Variable, ...]:
        """The variables of one causality, in the order of the table."""
        return tuple(v for v in self.table if v.causality is causality)

    def variable_named(self, name: str) -> Variable:
        """The variable of that name."""
        return next(v for v in self.table if v.name == name)

    def reference(self, v: Variable) -> int:
        """Value reference of the first entry of a variable."""
        return VR_STRIDE * self.numbers[v.name]

    def count(self, v: Variable) -> int:
        """Number of entries of a variable."""
        return v.count(len(self.legs))

    def start(self, v: Variable) -> tuple[Value, ...]:
        """Start values of a variable, one per entry; empty for an output."""
        if v.name in self.starts:
            return self.starts[v.name]
        return () if v.start is None else (v.start,) * self.count(v)

    def type_of(self, v: Variable) -> Type:
        """FMI type of a variable, which the build may choose simpler than the table."""
        if self.reals:
            return Type.real
        if v.enumeration and self.enumerations_as == "integer":
            return Type.integer
        return v.type

    @property
    def units(self) -> tuple[str, ...]:
        """Units of the variables, in the order of the types."""
        used = {v.unit for v in self.table}
        return tuple(unit for unit in self.types if unit in used)

    def describe(self, v: Variable) -> str:
        """Description of a variable, with the items of an enumeration that is a number."""
        if v.enumeration and self.type_of(v) is not Type.enumeration:
            items = ", ".join(f"{item.value} {item.name}" for item in v.enumeration.items)
            return f"{v.description}: {items}"
        return v.description

    @property
    def arrays(self) -> bool:
        """Whether a variable with several entries is an array."""
        return self.fmi == 3 and self.naming == "structured"

    def describe_entry(self, v: Variable, element: int) -> str:
        """Description of one entry of a variable, with the leg or the legs it belongs to."""
        if v.shape is Shape.leg:
            return f"{self.legs[element]}: {self.describe(v)}"
        if v.shape is Shape.relation:
            return f"{self.legs[0]} and {self.legs[element + 1]}: {self.describe(v)}"
        return self.describe(v)


def check_choices(naming: str, fmi: int, enumerations: str) -> None:
    """Refuse a choice that no build has.

    Raises:
        BuildError: naming, version or form of enumerations outside what is allowed.
    """
    for name, value, allowed in (
        ("naming", naming, NAMINGS),
        ("enumerations", enumerations, ENUMERATIONS_AS),
    ):
        if value not in allowed:
            raise BuildError(f"{name} '{value}' is not one of {', '.join(allowed)}")
    if fmi not in FMI_VERSIONS:
        raise BuildError(f"fmi = {fmi} is not one of 2, 3")
