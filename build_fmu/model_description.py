"""modelDescription.xml of FMI 2.0, from the table of variables."""

from __future__ import annotations

from lxml import etree

from apnc_core.enumerations import ENUMERATIONS
from apnc_core.legs import leg_names
from apnc_core.schema import Causality, Shape, Variable
from apnc_core.variables import Scalar, row, scalars
from build_fmu.description_parts import (
    ABOUT,
    REAL_TYPES,
    about,
    add_experiment,
    add_log_categories,
    add_units,
    initial,
    number,
    type_of,
    typed_attributes,
)
from build_fmu.options import MODEL, BuildOptions


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
        description=about(options),
        **ABOUT,
        variableNamingConvention="structured" if options.naming == "structured" else "flat",
        numberOfEventIndicators="0",
    )
    _co_simulation(root, c_files)
    add_units(root)
    _types(etree.SubElement(root, "TypeDefinitions"))
    add_log_categories(root)
    add_experiment(root, options)
    members = list(scalars(options.legs, options.naming))
    variables = etree.SubElement(root, "ModelVariables")
    for member in members:
        _scalar_variable(variables, member, options)
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


def _types(parent: etree._Element) -> None:
    for unit, (name, description, quantity) in REAL_TYPES.items():
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


def _scalar_variable(parent: etree._Element, member: Scalar, options: BuildOptions) -> None:
    v = member.variable
    kind = type_of(v, options)
    element = etree.SubElement(
        parent,
        "ScalarVariable",
        name=member.name,
        valueReference=str(member.value_reference),
        description=_description(v, member.element, leg_names(options.legs)),
        causality=v.causality.value,
        variability=v.variability,
        **initial(v),
    )
    typed = etree.SubElement(element, kind.value, **typed_attributes(v, options))
    for value in options.start(v)[member.element : member.element + 1]:
        typed.set("start", number(value))


def _description(v: Variable, element: int, legs: tuple[str, ...]) -> str:
    if v.shape is Shape.leg:
        return f"{legs[element]}: {v.description}"
    if v.shape is Shape.relation:
        return f"{legs[0]} and {legs[element + 1]}: {v.description}"
    return v.description


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
