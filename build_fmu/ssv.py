"""Parameters as an SSV file: the parameter set of SSP 1.0, which system tools read."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Final

from lxml import etree

from apnc_core.schema import Causality, Shape, Type, Variable
from apnc_core.settings import Setting, SettingLike
from apnc_core.variables import variables_of
from build_fmu.description_parts import UNITS, number
from build_fmu.options import NAMINGS, checked
from build_fmu.platforms import BuildError
from build_fmu.writing import write_atomically

_SSV: Final = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
_SSC: Final = "http://ssp-standard.org/SSP1/SystemStructureCommon"


def write_ssv(settings: Mapping[str, SettingLike], path: Path, naming: str = "structured") -> None:
    """Write parameters as an SSV file.

    Args:
        settings: values by parameter name; one per entry for a parameter with several.
        path: file to write.
        naming: of the FMU they are for, ``structured`` or ``flat``.

    An enumeration is written by the name of its item, as the standard has it.

    Raises:
        BuildError: no such parameter, or a value that does not fit.
        OSError: the file cannot be written.
    """
    values = {name: checked(name, value) for name, value in settings.items()}
    root = etree.Element(f"{{{_SSV}}}ParameterSet", nsmap={"ssv": _SSV, "ssc": _SSC})
    root.set("version", "1.0")
    root.set("name", "apnc")
    parameters = etree.SubElement(root, f"{{{_SSV}}}Parameters")
    used = [v for v in variables_of(Causality.parameter) if v.name in values]
    for v in used:
        value = values[v.name]
        entries = value if isinstance(value, tuple) else (value,)
        for element, entry in enumerate(entries):
            parameter = etree.SubElement(parameters, f"{{{_SSV}}}Parameter")
            parameter.set("name", v.scalar_name(element, naming))
            typed = etree.SubElement(parameter, f"{{{_SSV}}}{v.type.value}")
            if v.enumeration:
                typed.set("value", v.enumeration.items(int(entry)).name)
                typed.set("name", v.enumeration.name)
            else:
                typed.set("value", number(entry))
            if v.unit:
                typed.set("unit", v.unit)
    _add_enumerations(root, used)
    _add_units(root, used)
    text = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    write_atomically(path, text)


def _add_enumerations(root: etree._Element, used: list[Variable]) -> None:
    known = [v.enumeration for v in used if v.enumeration]
    parent = etree.SubElement(root, f"{{{_SSV}}}Enumerations") if known else root
    for enumeration in known:
        element = etree.SubElement(parent, f"{{{_SSC}}}Enumeration", name=enumeration.name)
        for item in enumeration.items:
            etree.SubElement(element, f"{{{_SSC}}}Item", name=item.name, value=str(item.value))


def _add_units(root: etree._Element, used: list[Variable]) -> None:
    names = {v.unit for v in used if v.unit}
    parent = etree.SubElement(root, f"{{{_SSV}}}Units") if names else root
    for name in sorted(names):
        unit = etree.SubElement(parent, f"{{{_SSC}}}Unit", name=name)
        etree.SubElement(unit, f"{{{_SSC}}}BaseUnit", **UNITS[name])


def read_ssv(path: Path) -> dict[str, Setting]:
    """Parameters from an SSV file, by name; checked.

    Args:
        path: file to read; its names may be structured or flat, its enumerations items by name
            or integers.

    Raises:
        BuildError: no file, not an SSV file, or a parameter that does not exist or fit.
    """
    try:
        root = etree.fromstring(path.read_bytes(), etree.XMLParser(resolve_entities=False))
    except OSError as error:
        raise BuildError(f"{path} cannot be read: {error.strerror}") from None
    except etree.XMLSyntaxError as error:
        raise BuildError(f"{path} is not an SSV file: {error.msg}") from None
    if root.tag != f"{{{_SSV}}}ParameterSet":
        raise BuildError(f"{path} is not an SSV file of SSP 1.0: its root is {root.tag}")
    single: dict[str, SettingLike] = {}
    several: dict[str, dict[int, float]] = {}
    for parameter in root.iterfind(f"{{{_SSV}}}Parameters/{{{_SSV}}}Parameter"):
        try:
            v, element, value = _entry(parameter)
        except ValueError as error:
            raise BuildError(f"{path}: {error}") from None
        if v.shape is Shape.scalar:
            single[v.name] = value
        else:
            several.setdefault(v.name, {})[element] = float(value)
    for name, entries in several.items():
        if sorted(entries) != list(range(len(entries))):
            raise BuildError(f"{path}: entries of {name} are missing")
        single[name] = tuple(entries[k] for k in sorted(entries))
    return {name: checked(name, value) for name, value in single.items()}


def _entry(parameter: etree._Element) -> tuple[Variable, int, float | str]:
    """Parameter, entry and value of one Parameter element."""
    name = parameter.get("name", "")
    v, element = _parameter_of(name)
    typed = next((e for e in parameter if etree.QName(e).localname in set(Type)), None)
    if typed is None:
        raise BuildError(f"{name} has no number, flag or item")
    kind, text = Type(etree.QName(typed).localname), typed.get("value", "")
    if v.unit and typed.get("unit", v.unit) != v.unit:
        raise BuildError(f"unit '{typed.get('unit')}' of {name} is not {v.unit}")
    if v.type is Type.boolean and kind is Type.boolean:
        if text not in ("true", "false", "1", "0"):
            raise BuildError(f"{name} = {text} is not true or false")
        return v, element, text in ("true", "1")
    if v.enumeration and kind is Type.enumeration:
        return v, element, text
    try:
        return v, element, float(text) if kind is Type.real else int(text)
    except ValueError:
        raise BuildError(f"{name} = '{text}' is not a number") from None


def _parameter_of(name: str) -> tuple[Variable, int]:
    for v in variables_of(Causality.parameter):
        for element in range(v.count(64)):
            if name in (v.scalar_name(element, naming) for naming in NAMINGS):
                return v, element
    known = ", ".join(v.name for v in variables_of(Causality.parameter))
    raise BuildError(f"parameter '{name}' is not one of {known}")
