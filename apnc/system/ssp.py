"""A system as the files of SSP 1.0: SystemStructure.ssd and a parameter set for each FMU."""

from __future__ import annotations

from typing import Final

from lxml import etree

from apnc.system.structure import RESOURCES, Component, Start, Structure
from build_fmu.description_parts import ABOUT, number

SSD_FILE: Final = "SystemStructure.ssd"

_BASE: Final = "http://ssp-standard.org/SSP1/SystemStructure"
_NAMESPACES: Final = {
    "ssd": f"{_BASE}Description",
    "ssc": f"{_BASE}Common",
    "ssv": f"{_BASE}ParameterValues",
}


def _add(parent: etree._Element, tag: str, /, **attributes: str) -> etree._Element:
    return etree.SubElement(parent, _tag(tag), attrib=attributes)


def _tag(name: str) -> str:
    prefix, _, local = name.partition(":")
    return f"{{{_NAMESPACES[prefix]}}}{local}"


def _root(tag: str, /, **attributes: str) -> etree._Element:
    prefix = tag.partition(":")[0]
    namespaces = {p: _NAMESPACES[p] for p in (prefix, "ssc")}
    about = {"version": "1.0", "generationTool": ABOUT["generationTool"]}
    return etree.Element(_tag(tag), attrib={**about, **attributes}, nsmap=namespaces)


def _text(root: etree._Element) -> bytes:
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def _unit(unit: str | None) -> dict[str, str]:
    return {"unit": unit} if unit else {}


def _add_units(parent: etree._Element, prefix: str, structure: Structure) -> None:
    units = _add(parent, f"{prefix}:Units")
    for name, exponents in structure.units.items():
        _add(_add(units, "ssc:Unit", name=name), "ssc:BaseUnit", **exponents)


def ssd(structure: Structure) -> bytes:
    """SystemStructure.ssd."""
    root = _root("ssd:SystemStructureDescription", name=structure.name)
    system = _add(root, "ssd:System", name=structure.name)
    elements = _add(system, "ssd:Elements")
    for component in structure.components:
        _add_component(elements, component)
    connections = _add(system, "ssd:Connections")
    for (start, output), (end, entry) in structure.connections:
        _add(
            connections, "ssd:Connection",
            startElement=start, startConnector=output, endElement=end, endConnector=entry,
        )  # fmt: skip
    _add_units(root, "ssd", structure)
    _add(root, "ssd:DefaultExperiment", startTime="0", stopTime=number(structure.stop))
    return _text(root)


def _add_component(elements: etree._Element, component: Component) -> None:
    element = _add(
        elements, "ssd:Component", name=component.name, source=component.source,
        type="application/x-fmu-sharedlibrary", implementation="CoSimulation",
    )  # fmt: skip
    connectors = _add(element, "ssd:Connectors")
    for c in component.connectors:
        connector = _add(connectors, "ssd:Connector", name=c.name, kind=c.kind)
        _add(connector, f"ssc:{c.type}", **_unit(c.unit))
    # bound here, since libcosim and Ecos do not look at bindings of the whole system
    bindings = _add(element, "ssd:ParameterBindings")
    source, kind = ssv_file(component), "application/x-ssp-parameter-set"
    _add(bindings, "ssd:ParameterBinding", type=kind, source=source)


def ssv_file(component: Component) -> str:
    """Path of the parameter set of an FMU in the archive."""
    return f"{RESOURCES}/{component.name}.ssv"


def ssv(structure: Structure, component: Component) -> bytes:
    """The parameter set of one FMU, by its own names."""
    # one name for all: Ecos is asked for a parameter set by its name
    root = _root("ssv:ParameterSet", name=structure.name)
    parameters = _add(root, "ssv:Parameters")
    for start in structure.starts:
        if start.component == component.name:
            parameter = _add(parameters, "ssv:Parameter", name=start.name)
            _add(parameter, f"ssv:{start.type}", value=value_text(start), **_unit(start.unit))
    _add_units(root, "ssv", structure)
    return _text(root)


def value_text(start: Start) -> str:
    """A start value as XML Schema has it."""
    return number(start.value)
