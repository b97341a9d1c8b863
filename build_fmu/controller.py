"""The controller as a model from which its FMU is built."""

from __future__ import annotations

from typing import Final

from apnc_core.enumerations import ENUMERATIONS
from apnc_core.legs import leg_names
from apnc_core.variable_numbers import VARIABLE_NUMBERS
from apnc_core.variables import TABLE
from build_fmu.model import Model, RealType
from build_fmu.options import MODEL, BuildOptions

REAL_TYPES: Final = {
    "1": RealType("Number", "dimensionless number", ""),
    "s": RealType("Duration", "duration", "Time"),
    "N": RealType("Load", "load on a foot, or a weight", "Force"),
    "rad": RealType("Angle", "angle", "Angle"),
}
LOG_CATEGORIES: Final = {
    "logStatusWarning": "inputs that cannot be used, steps longer than a tick",
    "logStatusError": "calls and values that are not allowed",
    "logEvents": "start of the simulation",
}
_ABOUT: Final = "Adaptive neural controller of a legged robot: self-organised, memorised gaits"


def controller_model(options: BuildOptions) -> Model:
    """The model of a build.

    Args:
        options: what is built.
    """
    own = options.own_defaults()
    return Model(
        identifier=MODEL,
        about=f"{_ABOUT}; starts with {own}" if own else _ABOUT,
        table=TABLE,
        numbers=VARIABLE_NUMBERS,
        legs=leg_names(options.legs),
        starts={v.name: options.start(v) for v in TABLE},
        enumerations=ENUMERATIONS,
        types=REAL_TYPES,
        log_categories=LOG_CATEGORIES,
        step=options.parameters().Ts,
        naming=options.naming,
        fmi=options.fmi,
        enumerations_as=options.enumerations,
        reals=options.reals,
    )
