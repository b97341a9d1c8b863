"""modelDescription.xml of FMI 3.0, from the table of variables: legs as arrays."""

from __future__ import annotations

from typing import Final

from lxml import etree

from apnc_core.schema import VR_TIME, Causality, Shape, Type, Variable
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

_TAGS: Final = {
    Type.real: "Float64",
    Type.integer: "Int32",
    Type.boolean: "Boolean",
    Type.enumeration: "Enumeration",
}


def model_description_fmi3(model: Model, token: str) -> bytes:
    """The XML text.

    Args:
        model: what is described.
        token: instantiation token, what the binary checks.
    """
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=model.identifier,
        instantiationToken=token,
        description=model.about,
        **ABOUT,
        variableNamingConvention="structured",
    )
    etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model.identifier,
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
    )
    add_units(root, model)
    _add_types(etree.SubElement(root, "TypeDefinitions"), model)
    add_log_categories(root, model)
    add_experiment(root, model)
    variables = etree.SubElement(root, "ModelVariables")
    etree.SubElement(
        variables,
        "Float64",
        name="time",
        valueReference=str(VR_TIME),
        description="simulated time",
        causality="independent",
        variability="continuous",
        unit="s",
    )
    for variable in model.table:
        _add_variable(variables, variable, model)
    _add_structure(etree.SubElement(root, "ModelStructure"), model)
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def build_description(model: Model, c_files: list[str]) -> bytes:
    """``sources/buildDescription.xml``: how to compile the sources."""
    root = etree.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = etree.SubElement(root, "BuildConfiguration", modelIdentifier=model.identifier)
    files = etree.SubElement(configuration, "SourceFileSet", language="C11")
    for name in c_files:
        etree.SubElement(files, "SourceFile", name=name)
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def _add_types(parent: etree._Element, model: Model) -> None:
    """No ``description`` on a type: FMPy 0.3.23 and older refuse it."""
    for unit in model.units:
        name, _, quantity = model.types[unit]
        real = etree.SubElement(parent, "Float64Type", name=name, unit=unit)
        if quantity:
            real.set("quantity", quantity)
    for enumeration in model.enumerations:
        element = etree.SubElement(parent, "EnumerationType", name=enumeration.name)
        for item, text in zip(enumeration.items, enumeration.descriptions, strict=True):
            etree.SubElement(
                element, "Item", name=item.name, value=str(item.value), description=text
            )


def _add_variable(parent: etree._Element, v: Variable, model: Model) -> None:
    element = etree.SubElement(
        parent,
        _TAGS[model.type_of(v)],
        name=v.name,
        valueReference=str(model.reference(v)),
        description=model.describe(v),
        causality=v.causality.value,
        variability=v.variability,
        **initial(v),
        **typed_attributes(v, model),
    )
    if start := model.start(v):
        element.set("start", " ".join(map(number, start)))
    if v.shape is not Shape.scalar:
        etree.SubElement(element, "Dimension", start=str(model.count(v)))


def _add_structure(parent: etree._Element, model: Model) -> None:
    """Outputs change in steps only, so none depends on an input at the same instant."""
    reference = {v.name: str(model.reference(v)) for v in model.table}
    outputs = model.variables_of(Causality.output)
    for v in outputs:
        etree.SubElement(parent, "Output", valueReference=reference[v.name], dependencies="")
    for v in outputs:
        sources = " ".join(sorted((reference[name] for name in v.initial_from), key=int))
        etree.SubElement(
            parent, "InitialUnknown", valueReference=reference[v.name], dependencies=sources
        )
