"""modelDescription.xml of FMI 2.0, from the table of variables."""

from __future__ import annotations

from lxml import etree

from apnc_core.schema import Causality, Scalar, Shape
from build_fmu.description_parts import (
    ABOUT,
    add_experiment,
    add_log_categories,
    add_units,
    initial,
    number,
    typed_attributes,
)
from build_fmu.model import Model


def model_description(model: Model, c_files: list[str], guid: str) -> bytes:
    """The XML text.

    Args:
        model: what is described.
        c_files: names of the files to compile, in ``sources/``.
        guid: what the binary checks.
    """
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=model.identifier,
        guid=guid,
        description=model.about,
        **ABOUT,
        variableNamingConvention="structured" if model.naming == "structured" else "flat",
        numberOfEventIndicators="0",
    )
    _co_simulation(root, model, c_files)
    add_units(root, model)
    _types(etree.SubElement(root, "TypeDefinitions"), model)
    add_log_categories(root, model)
    add_experiment(root, model)
    members = model.scalars()
    variables = etree.SubElement(root, "ModelVariables")
    for member in members:
        _scalar_variable(variables, member, model)
    _structure(etree.SubElement(root, "ModelStructure"), members, model)
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def _co_simulation(root: etree._Element, model: Model, c_files: list[str]) -> None:
    element = etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model.identifier,
        canHandleVariableCommunicationStepSize="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
    )
    files = etree.SubElement(element, "SourceFiles")
    for name in c_files:
        etree.SubElement(files, "File", name=name)


def _types(parent: etree._Element, model: Model) -> None:
    for unit in model.units:
        name, description, quantity = model.types[unit]
        simple = etree.SubElement(parent, "SimpleType", name=name, description=description)
        real = etree.SubElement(simple, "Real", unit=unit)
        if quantity:
            real.set("quantity", quantity)
    for enumeration in model.enumerations:
        simple = etree.SubElement(parent, "SimpleType", name=enumeration.name)
        element = etree.SubElement(simple, "Enumeration")
        for item, text in zip(enumeration.items, enumeration.descriptions, strict=True):
            etree.SubElement(
                element, "Item", name=item.name, value=str(item.value), description=text
            )


def _scalar_variable(parent: etree._Element, member: Scalar, model: Model) -> None:
    v = member.variable
    element = etree.SubElement(
        parent,
        "ScalarVariable",
        name=member.name,
        valueReference=str(member.value_reference),
        description=model.describe_entry(v, member.element),
        causality=v.causality.value,
        variability=v.variability,
        **initial(v),
    )
    typed = etree.SubElement(element, model.type_of(v).value, **typed_attributes(v, model))
    for value in model.start(v)[member.element : member.element + 1]:
        typed.set("start", number(float(value) if model.reals else value))


def _structure(parent: etree._Element, members: list[Scalar], model: Model) -> None:
    """Outputs change in steps only, so none depends on an input at the same instant."""
    position = {(m.variable.name, m.element): i + 1 for i, m in enumerate(members)}
    outputs = [m for m in members if m.variable.causality is Causality.output]
    listed = etree.SubElement(parent, "Outputs")
    for member in outputs:
        index = position[member.variable.name, member.element]
        etree.SubElement(listed, "Unknown", index=str(index), dependencies="")
    initial = etree.SubElement(parent, "InitialUnknowns")
    for member in outputs:
        sources = sorted(
            position[
                name, 0 if model.variable_named(name).shape is Shape.scalar else member.element
            ]
            for name in member.variable.initial_from
        )
        etree.SubElement(
            initial,
            "Unknown",
            index=str(position[member.variable.name, member.element]),
            dependencies=" ".join(map(str, sources)),
        )
