"""modelDescription.xml of FMI 3.0, from the table of variables: one array per row."""

from __future__ import annotations

from typing import Final

from lxml import etree

from apnc_core.enumerations import ENUMERATIONS
from apnc_core.schema import VR_TIME, Causality, Shape, Type, Variable
from apnc_core.variables import TABLE, value_reference
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

_TAGS: Final = {
    Type.real: "Float64",
    Type.integer: "Int32",
    Type.boolean: "Boolean",
    Type.enumeration: "Enumeration",
}


def model_description_fmi3(options: BuildOptions, token: str) -> bytes:
    """The XML text.

    Args:
        options: number of legs.
        token: instantiation token, what the binary checks.
    """
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=MODEL,
        instantiationToken=token,
        description=about(options),
        **ABOUT,
        variableNamingConvention="structured",
    )
    etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=MODEL,
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
    )
    add_units(root)
    _add_types(etree.SubElement(root, "TypeDefinitions"))
    add_log_categories(root)
    add_experiment(root, options)
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
    for variable in TABLE:
        _add_variable(variables, variable, options)
    _add_structure(etree.SubElement(root, "ModelStructure"))
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def build_description(c_files: list[str]) -> bytes:
    """``sources/buildDescription.xml``: how to compile the sources."""
    root = etree.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = etree.SubElement(root, "BuildConfiguration", modelIdentifier=MODEL)
    files = etree.SubElement(configuration, "SourceFileSet", language="C11")
    for name in c_files:
        etree.SubElement(files, "SourceFile", name=name)
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def _add_types(parent: etree._Element) -> None:
    """No ``description`` on a type: FMPy 0.3.23 and older refuse it."""
    for unit, (name, _, quantity) in REAL_TYPES.items():
        real = etree.SubElement(parent, "Float64Type", name=name, unit=unit)
        if quantity:
            real.set("quantity", quantity)
    for enumeration in ENUMERATIONS:
        element = etree.SubElement(parent, "EnumerationType", name=enumeration.name)
        for item, text in zip(enumeration.items, enumeration.descriptions, strict=True):
            etree.SubElement(
                element, "Item", name=item.name, value=str(item.value), description=text
            )


def _add_variable(parent: etree._Element, v: Variable, options: BuildOptions) -> None:
    element = etree.SubElement(
        parent,
        _TAGS[type_of(v, options)],
        name=v.name,
        valueReference=str(value_reference(v.name)),
        description=v.description,
        causality=v.causality.value,
        variability=v.variability,
        **initial(v),
        **typed_attributes(v, options),
    )
    if start := options.start(v):
        element.set("start", " ".join(map(number, start)))
    if v.shape is not Shape.scalar:
        etree.SubElement(element, "Dimension", start=str(v.count(options.legs)))


def _add_structure(parent: etree._Element) -> None:
    """Outputs change at ticks only, so none depends on an input at the same instant."""
    reference = {v.name: str(value_reference(v.name)) for v in TABLE}
    outputs = [v for v in TABLE if v.causality is Causality.output]
    for v in outputs:
        etree.SubElement(parent, "Output", valueReference=reference[v.name], dependencies="")
    for v in outputs:
        sources = " ".join(sorted((reference[name] for name in v.initial_from), key=int))
        etree.SubElement(
            parent, "InitialUnknown", valueReference=reference[v.name], dependencies=sources
        )
