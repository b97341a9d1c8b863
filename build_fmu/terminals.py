"""terminalsAndIcons.xml of FMI 3.0: what belongs together in one connection, and the icon.

A controller and a robot have the same terminals with the same members, loads and commands of a
leg. A tool that knows terminals then connects a leg by one line instead of three.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from lxml import etree

from build_fmu.model import Model

FOLDER: Final = "terminalsAndIcons"
PATH: Final = f"{FOLDER}/terminalsAndIcons.xml"
ICON: Final = f"{FOLDER}/icon.png"

MEMBERS: Final = ("grf", "theta_hip", "theta_knee")
"""Variables of a leg that controller and robot exchange."""

_SIZE: Final = "100"


def terminals_and_icons(model: Model) -> bytes:
    """The XML text.

    Args:
        model: whose variables the terminals hold. With arrays there is one terminal for all legs,
            because a member is a whole variable; else there is one for each leg.

    The matching rule ``plug`` connects members of the same name.
    """
    root = etree.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    picture = etree.SubElement(root, "GraphicalRepresentation")
    corners = {"x1": "0", "y1": "0", "x2": _SIZE, "y2": _SIZE}
    etree.SubElement(picture, "CoordinateSystem", **corners, suggestedScalingFactorTo_mm="0.2")
    etree.SubElement(picture, "Icon", **corners)
    parent = etree.SubElement(root, "Terminals")
    for name, description, members in _terminals(model):
        terminal = etree.SubElement(
            parent, "Terminal", name=name, matchingRule="plug", description=description
        )
        for member, variable in members.items():
            etree.SubElement(
                terminal,
                "TerminalMemberVariable",
                variableName=variable,
                memberName=member,
                variableKind="signal",
            )
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text


def _terminals(model: Model) -> Iterator[tuple[str, str, dict[str, str]]]:
    """Name, description, and variable by member of every terminal."""
    if model.arrays:
        yield "legs", "loads and joint commands of all legs", {name: name for name in MEMBERS}
        return
    variables = [model.variable_named(name) for name in MEMBERS]
    for leg, name in enumerate(model.legs):
        members = {v.name: v.scalar_name(leg, model.naming) for v in variables}
        yield f"leg{leg + 1}", f"load and joint commands of leg {name}", members
