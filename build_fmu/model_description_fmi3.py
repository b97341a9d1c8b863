"""modelDescription.xml of FMI 3.0, from the table of variables.

With structured names the entries of a variable are an array, with flat names a scalar each.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from lxml import etree

from apnc_core.schema import VR_TIME, Causality, Scalar, Shape, Type, Value, Variable
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
        variableNamingConvention=model.naming,
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
    if model.arrays:
        for v in model.table:
            _add_array(variables, v, model)
    else:
        for member in model.scalars():
            _add_scalar(variables, member, model)
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


def _add_array(parent: etree._Element, v: Variable, model: Model) -> None:
    """A variable with all its entries; one entry is no array."""
    described = (v.name, model.reference(v), model.describe(v))
    element = _add_variable(parent, v, model, *described, model.start(v))
    if v.shape is not Shape.scalar:
        etree.SubElement(element, "Dimension", start=str(model.count(v)))


def _add_scalar(parent: etree._Element, member: Scalar, model: Model) -> None:
    """One entry of a variable as a variable of its own."""
    v, element = member.variable, member.element
    described = (member.name, member.value_reference, model.describe_entry(v, element))
    _add_variable(parent, v, model, *described, model.start(v)[element : element + 1])


def _add_variable(
    parent: etree._Element,
    v: Variable,
    model: Model,
    name: str,
    reference: int,
    description: str,
    start: tuple[Value, ...],
) -> etree._Element:
    element = etree.SubElement(
        parent,
        _TAGS[model.type_of(v)],
        name=name,
        valueReference=str(reference),
        description=description,
        causality=v.causality.value,
        variability=v.variability,
        **initial(v),
        **typed_attributes(v, model),
    )
    if start:
        numbers = [number(float(value) if model.reals else value) for value in start]
        element.set("start", " ".join(numbers))
    return element


def _add_structure(parent: etree._Element, model: Model) -> None:
    """Outputs change in steps only, so none depends on an input at the same instant."""
    outputs = [
        (v, element)
        for v in model.variables_of(Causality.output)
        for element in range(1 if model.arrays else model.count(v))
    ]
    for v, element in outputs:
        reference = str(model.reference(v) + element)
        etree.SubElement(parent, "Output", valueReference=reference, dependencies="")
    for v, element in outputs:
        etree.SubElement(
            parent,
            "InitialUnknown",
            valueReference=str(model.reference(v) + element),
            dependencies=" ".join(map(str, sorted(_sources(v, element, model)))),
        )


def _sources(v: Variable, element: int, model: Model) -> Iterator[int]:
    """Value references of the parameters that determine the initial value of an output."""
    for name in v.initial_from:
        source = model.variable_named(name)
        yield model.reference(source) + (0 if source.shape is Shape.scalar else element)
