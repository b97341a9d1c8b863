"""modelDescription.xml of FMI 2.0, from the table of variables."""

from __future__ import annotations

from typing import Final

from lxml import etree

import apnc_core
from apnc_core.enumerations import ENUMERATIONS
from apnc_core.legs import leg_names
from apnc_core.schema import Causality, Shape, Type, Variable
from apnc_core.variables import Scalar, row, scalars
from build_fmu.options import MODEL, BuildOptions

UNITS: Final[dict[str, dict[str, str]]] = {
    "1": {},
    "s": {"s": "1"},
    "N": {"kg": "1", "m": "1", "s": "-2"},
    "rad": {"rad": "1"},
}
DEGREES_PER_RADIAN: Final = 57.29577951308232
_REAL_TYPES: Final = {
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
STOP_TIME: Final = "45"


def model_description(options: BuildOptions, c_files: list[str], guid: str) -> bytes:
    """The XML text.

    Args:
        options: number of legs and naming.
        c_files: names of the files to compile, in ``sources/``.
        guid: what the binary checks.
    """
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=MODEL,
        guid=guid,
        description="Adaptive neural controller of a legged robot: self-organised, memorised gaits",
        author="The APNC developers",
        version=apnc_core.__version__,
        copyright="(c) 2026 The APNC developers",
        license="BSD-3-Clause",
        generationTool=f"apnc {apnc_core.__version__}",
        variableNamingConvention="structured" if options.naming == "structured" else "flat",
        numberOfEventIndicators="0",
    )
    _co_simulation(root, c_files)
    _units(etree.SubElement(root, "UnitDefinitions"))
    _types(etree.SubElement(root, "TypeDefinitions"))
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)
    etree.SubElement(
        root,
        "DefaultExperiment",
        startTime="0",
        stopTime=STOP_TIME,
        stepSize=_number(row("Ts").start),
    )
    members = list(scalars(options.legs, options.naming))
    variables = etree.SubElement(root, "ModelVariables")
    for member in members:
        _scalar_variable(variables, member, leg_names(options.legs))
    _structure(etree.SubElement(root, "ModelStructure"), members)
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def _co_simulation(root: etree._Element, c_files: list[str]) -> None:
    element = etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=MODEL,
        canHandleVariableCommunicationStepSize="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
    )
    files = etree.SubElement(element, "SourceFiles")
    for name in c_files:
        etree.SubElement(files, "File", name=name)


def _units(parent: etree._Element) -> None:
    for name, exponents in UNITS.items():
        unit = etree.SubElement(parent, "Unit", name=name)
        etree.SubElement(unit, "BaseUnit", **exponents)
        if name == "rad":
            etree.SubElement(unit, "DisplayUnit", name="deg", factor=repr(DEGREES_PER_RADIAN))


def _types(parent: etree._Element) -> None:
    for unit, (name, description, quantity) in _REAL_TYPES.items():
        simple = etree.SubElement(parent, "SimpleType", name=name, description=description)
        real = etree.SubElement(simple, "Real", unit=unit)
        if quantity:
            real.set("quantity", quantity)
    for enumeration in ENUMERATIONS:
        simple = etree.SubElement(parent, "SimpleType", name=enumeration.name)
        element = etree.SubElement(simple, "Enumeration")
        for item, text in zip(enumeration.items, enumeration.descriptions, strict=True):
            etree.SubElement(
                element, "Item", name=item.name, value=str(item.value), description=text
            )


def _scalar_variable(parent: etree._Element, member: Scalar, legs: tuple[str, ...]) -> None:
    v = member.variable
    element = etree.SubElement(
        parent,
        "ScalarVariable",
        name=member.name,
        valueReference=str(member.value_reference),
        description=_description(v, member.element, legs),
        causality=v.causality.value,
        variability=v.variability,
    )
    if v.causality is Causality.parameter:
        element.set("initial", "exact")
    elif v.causality is not Causality.input:
        element.set("initial", "calculated")
    typed = etree.SubElement(element, v.type.value)
    if v.enumeration:
        typed.set("declaredType", v.enumeration.name)
    elif v.type is Type.real:
        assert v.unit is not None
        typed.set("declaredType", _REAL_TYPES[v.unit][0])
    for attribute, value in (("unit", v.unit), ("displayUnit", v.display_unit)):
        if value:
            typed.set(attribute, value)
    for attribute, number in (("min", v.min), ("max", v.max), ("nominal", v.nominal)):
        if number is not None:
            typed.set(attribute, _number(number if v.type is Type.real else int(number)))
    if v.start is not None:
        typed.set("start", _number(v.start))


def _description(v: Variable, element: int, legs: tuple[str, ...]) -> str:
    if v.shape is Shape.leg:
        return f"{legs[element]}: {v.description}"
    if v.shape is Shape.relation:
        return f"{legs[0]} and {legs[element + 1]}: {v.description}"
    return v.description


def _number(value: float | int | bool | None) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(int(value)) if isinstance(value, int) else repr(value)


def _structure(parent: etree._Element, members: list[Scalar]) -> None:
    """Outputs change at ticks only, so none depends on an input at the same instant."""
    position = {(m.variable.name, m.element): i + 1 for i, m in enumerate(members)}
    outputs = [m for m in members if m.variable.causality is Causality.output]
    listed = etree.SubElement(parent, "Outputs")
    for member in outputs:
        index = position[member.variable.name, member.element]
        etree.SubElement(listed, "Unknown", index=str(index), dependencies="")
    initial = etree.SubElement(parent, "InitialUnknowns")
    for member in outputs:
        sources = sorted(
            position[name, 0 if row(name).shape is Shape.scalar else member.element]
            for name in member.variable.initial_from
        )
        etree.SubElement(
            initial,
            "Unknown",
            index=str(position[member.variable.name, member.element]),
            dependencies=" ".join(map(str, sources)),
        )
