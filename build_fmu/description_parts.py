"""Parts of modelDescription.xml that FMI 2.0 and 3.0 have in common."""

from __future__ import annotations

from typing import Final

from lxml import etree

import apnc_core
from apnc_core.schema import Causality, Type, Variable
from build_fmu.model import Model

UNITS: Final[dict[str, dict[str, str]]] = {
    "1": {},
    "s": {"s": "1"},
    "N": {"kg": "1", "m": "1", "s": "-2"},
    "rad": {"rad": "1"},
    "kg": {"kg": "1"},
    "m": {"m": "1"},
    "m/s": {"m": "1", "s": "-1"},
    "rad/s": {"rad": "1", "s": "-1"},
    "N.m": {"kg": "1", "m": "2", "s": "-2"},
    "J": {"kg": "1", "m": "2", "s": "-2"},
    "N.m/rad": {"kg": "1", "m": "2", "s": "-2", "rad": "-1"},
    "N.m.s/rad": {"kg": "1", "m": "2", "s": "-1", "rad": "-1"},
    "kg.m2": {"kg": "1", "m": "2"},
    "N/m": {"kg": "1", "s": "-2"},
    "N.s/m": {"kg": "1", "s": "-1"},
}
"""Units of all models, by their exponents of the SI base units."""

DEGREES_PER_RADIAN: Final = 57.29577951308232
ABOUT: Final = {
    "author": "The APNC developers",
    "version": apnc_core.__version__,
    "copyright": "(c) 2026 The APNC developers",
    "license": "BSD-3-Clause",
    "generationTool": f"apnc {apnc_core.__version__}",
}
STOP_TIME: Final = "45"


def number(value: float | int | bool | None) -> str:
    """Text of a value as XML Schema has it, without loss."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(int(value)) if isinstance(value, int) else repr(value)


def add_units(root: etree._Element, model: Model) -> None:
    """Append UnitDefinitions."""
    parent = etree.SubElement(root, "UnitDefinitions")
    for name in model.units:
        unit = etree.SubElement(parent, "Unit", name=name)
        etree.SubElement(unit, "BaseUnit", **UNITS[name])
        if name == "rad":
            etree.SubElement(unit, "DisplayUnit", name="deg", factor=repr(DEGREES_PER_RADIAN))


def add_log_categories(root: etree._Element, model: Model) -> None:
    """Append LogCategories."""
    categories = etree.SubElement(root, "LogCategories")
    for name, description in model.log_categories.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def add_experiment(root: etree._Element, model: Model) -> None:
    """Append DefaultExperiment with the model's tick as step size."""
    step = number(model.step)
    etree.SubElement(root, "DefaultExperiment", startTime="0", stopTime=STOP_TIME, stepSize=step)


def initial(v: Variable) -> dict[str, str]:
    """Attribute ``initial``; inputs have none."""
    if v.causality is Causality.input:
        return {}
    return {"initial": "exact" if v.causality is Causality.parameter else "calculated"}


def typed_attributes(v: Variable, model: Model) -> dict[str, str]:
    """Declared type, units and range."""
    attributes: dict[str, str] = {}
    kind = model.type_of(v)
    if v.enumeration and kind is not Type.enumeration:
        return {"min": "1", "max": str(len(v.enumeration.items))}
    if v.type is Type.boolean and kind is Type.real:
        return {"min": "0", "max": "1"}
    if v.enumeration:
        attributes["declaredType"] = v.enumeration.name
    elif v.type is Type.real:
        assert v.unit is not None
        attributes["declaredType"] = model.types[v.unit].name
    for name, text in (("unit", v.unit), ("displayUnit", v.display_unit)):
        if text:
            attributes[name] = text
    for name, value in (("min", v.min), ("max", v.max), ("nominal", v.nominal)):
        if value is not None:
            attributes[name] = number(value if v.type is Type.real else int(value))
    return attributes
