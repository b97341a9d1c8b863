"""Parts of modelDescription.xml that FMI 2.0 and 3.0 have in common."""

from __future__ import annotations

from typing import Final

from lxml import etree

import apnc_core
from apnc_core.schema import Causality, Type, Variable
from build_fmu.options import BuildOptions

UNITS: Final[dict[str, dict[str, str]]] = {
    "1": {},
    "s": {"s": "1"},
    "N": {"kg": "1", "m": "1", "s": "-2"},
    "rad": {"rad": "1"},
}
DEGREES_PER_RADIAN: Final = 57.29577951308232
REAL_TYPES: Final = {
    "1": ("Number", "dimensionless number", ""),
    "s": ("Duration", "duration", "Time"),
    "N": ("Load", "load on a foot, or a weight", "Force"),
    "rad": ("Angle", "angle", "Angle"),
}
LOG_CATEGORIES: Final = {
    "logStatusWarning": "unusable inputs",
    "logStatusError": "wrong calls and values",
    "logEvents": "life of the instance",
}
ABOUT: Final = {
    "author": "The APNC developers",
    "version": apnc_core.__version__,
    "copyright": "(c) 2026 The APNC developers",
    "license": "BSD-3-Clause",
    "generationTool": f"apnc {apnc_core.__version__}",
}
STOP_TIME: Final = "45"
_DESCRIPTION: Final = (
    "Adaptive neural controller of a legged robot: self-organised, memorised gaits"
)


def about(options: BuildOptions) -> str:
    """What the FMU is, and with which start values of its own."""
    own = options.own_defaults()
    return f"{_DESCRIPTION}; starts with {own}" if own else _DESCRIPTION


def number(value: float | int | bool | None) -> str:
    """Text of a value as XML Schema has it, without loss."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(int(value)) if isinstance(value, int) else repr(value)


def add_units(root: etree._Element) -> None:
    """Append UnitDefinitions."""
    parent = etree.SubElement(root, "UnitDefinitions")
    for name, exponents in UNITS.items():
        unit = etree.SubElement(parent, "Unit", name=name)
        etree.SubElement(unit, "BaseUnit", **exponents)
        if name == "rad":
            etree.SubElement(unit, "DisplayUnit", name="deg", factor=repr(DEGREES_PER_RADIAN))


def add_log_categories(root: etree._Element) -> None:
    """Append LogCategories."""
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def add_experiment(root: etree._Element, options: BuildOptions) -> None:
    """Append DefaultExperiment with the controller's tick as step size."""
    step = number(options.parameters().Ts)
    etree.SubElement(root, "DefaultExperiment", startTime="0", stopTime=STOP_TIME, stepSize=step)


def initial(v: Variable) -> dict[str, str]:
    """Attribute ``initial``; inputs have none."""
    if v.causality is Causality.input:
        return {}
    return {"initial": "exact" if v.causality is Causality.parameter else "calculated"}


def type_of(v: Variable, options: BuildOptions) -> Type:
    """FMI type of a row: an enumeration becomes an integer where the build says so."""
    if v.enumeration and options.enumerations == "integer":
        return Type.integer
    return v.type


def typed_attributes(v: Variable, options: BuildOptions) -> dict[str, str]:
    """Declared type, units and range."""
    attributes: dict[str, str] = {}
    if v.enumeration and type_of(v, options) is Type.integer:
        return {"min": "1", "max": str(len(v.enumeration.items))}
    if v.enumeration:
        attributes["declaredType"] = v.enumeration.name
    elif v.type is Type.real:
        assert v.unit is not None
        attributes["declaredType"] = REAL_TYPES[v.unit][0]
    for name, text in (("unit", v.unit), ("displayUnit", v.display_unit)):
        if text:
            attributes[name] = text
    for name, value in (("min", v.min), ("max", v.max), ("nominal", v.nominal)):
        if value is not None:
            attributes[name] = number(value if v.type is Type.real else int(value))
    return attributes
