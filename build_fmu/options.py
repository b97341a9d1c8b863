"""Options of a build."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from apnc_core import settings as core_settings
from apnc_core.in_python import in_python
from apnc_core.interface import Parameters
from apnc_core.presets import PRESETS, preset_values
from apnc_core.schema import MAX_LEGS, Causality, Value, Variable
from apnc_core.settings import Setting, SettingLike
from apnc_core.variables import TABLE, variable_named
from build_fmu.model import NAMINGS, check_choices
from build_fmu.platforms import (
    MODEL,
    PLATFORMS,
    BuildError,
    Platform,
    check_platforms,
    host_platform,
)

__all__ = [
    "MODEL", "NAMINGS", "PLATFORMS", "BuildError", "BuildOptions", "Platform", "host_platform",
]  # fmt: skip


@dataclass(frozen=True)
class BuildOptions:
    """Options of one build.

    Args:
        legs: number of legs, 2 to 64.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``). In FMI 3.0 the first
            makes arrays and the second a scalar per entry.
        platforms: names (FMI 2.0.5 folders) of the binaries to include; empty for sources only.
        fmi: version of the standard, 2 or 3.
        preset: set of parameters that the FMU starts with.
        settings: start values by parameter name, in place of those of the preset and the gait.
        gait: relations phi_1k [rad] of the stored gait that the FMU starts with, legs - 1 of
            them (``stored`` and ``phi_stored``); none if empty.
        enumerations: ``enumeration``, or ``integer`` for importers that drop enumerations.
        reals: whether every variable is a Real, for importers that read all of them so.

    Raises:
        BuildError: a value outside what is allowed.
    """

    legs: int = 4
    naming: str = "structured"
    platforms: tuple[str, ...] = tuple(PLATFORMS)
    fmi: int = 2
    preset: str = "lilibot"
    settings: Mapping[str, SettingLike] = field(default_factory=dict, hash=False)
    gait: tuple[float, ...] = ()
    enumerations: str = "enumeration"
    reals: bool = False

    def __post_init__(self) -> None:
        """Check the choices."""
        for name in ("legs", "naming", "platforms", "fmi", "preset", "gait", "enumerations"):
            object.__setattr__(self, name, in_python(getattr(self, name)))
        if not 2 <= self.legs <= MAX_LEGS:
            raise BuildError(f"legs = {self.legs} is not in 2 ... {MAX_LEGS}")
        if self.preset not in PRESETS:
            raise BuildError(f"preset '{self.preset}' is not one of {', '.join(PRESETS)}")
        check_platforms(self.platforms)
        check_choices(self.naming, self.fmi, self.enumerations)
        chosen: dict[str, SettingLike] = {}
        if self.gait:
            chosen = {"stored": True, "phi_stored": tuple(self.gait)}
        own = {name: checked(name, value) for name, value in (chosen | dict(self.settings)).items()}
        phi = own.get("phi_stored", ())
        if isinstance(phi, tuple) and len(phi) not in (0, self.legs - 1):
            raise BuildError(
                f"phi_stored has {len(phi)} values; {self.legs} legs take {self.legs - 1}"
            )
        object.__setattr__(self, "settings", dict(sorted(own.items())))
        object.__setattr__(self, "gait", ())

    def parameters(self) -> Parameters:
        """The parameters that the FMU starts with."""
        values: dict[str, Any] = {**preset_values(self.preset), **self.settings}
        return Parameters(**values)

    def start(self, v: Variable) -> tuple[Value, ...]:
        """Start values of a variable, one per entry; empty for an output."""
        if v.start is None:
            return ()
        value: Value | tuple[float, ...] = v.start
        if v.causality is Causality.parameter:
            value = getattr(self.parameters(), v.name)
        if not isinstance(value, tuple):
            return (value,) * v.count(self.legs)
        return value or (v.start,) * v.count(self.legs)

    def changed(self) -> list[Variable]:
        """The variables whose start values are not those of the table."""
        return [v for v in TABLE if set(self.start(v)) - {v.start}]

    def own_defaults(self) -> str:
        """The start values that differ from those of the table, in words; empty if none do."""
        parts = [] if self.preset == BuildOptions.preset else [f"preset {self.preset}"]
        parts += [f"{name} = {in_words(name, value)}" for name, value in self.settings.items()]
        return ", ".join(parts)


def in_words(name: str, value: SettingLike) -> str:
    """A value of a parameter as a person reads it: items by name, true and false in lower case."""
    return value_in_words(variable_named(name), value)


def value_in_words(v: Variable, value: SettingLike) -> str:
    """As ``in_words``, for a variable of any table."""
    if isinstance(value, Sequence):
        return " ".join(f"{x:.6g}" for x in value)
    if v.enumeration:
        return v.enumeration.items(int(value)).name
    return str(value).lower() if isinstance(value, bool) else f"{value:.6g}"


def checked(name: str, value: SettingLike) -> Setting:
    """The value in the type of its parameter, see :func:`apnc_core.settings.checked`.

    Raises:
        BuildError: no such parameter, or a value of another type or outside the range.
    """
    try:
        return core_settings.checked(name, value)
    except ValueError as error:
        raise BuildError(str(error)) from None
