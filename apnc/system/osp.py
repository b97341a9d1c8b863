"""A system as OspSystemStructure.xml of the Open Simulation Platform."""

from __future__ import annotations

import math
from typing import Final

from lxml import etree

from apnc.system.ssp import value_text
from apnc.system.structure import Structure

OSP_FILE: Final = "OspSystemStructure.xml"
NANOSECONDS: Final = 1e9
"""In a second."""

_NAMESPACE: Final = "http://opensimulationplatform.com/MSMI/OSPSystemStructure"


def osp(structure: Structure) -> bytes:
    """Content of OspSystemStructure.xml.

    Pitfall: steps are whole nanoseconds there. The step is rounded down: if it were longer than a
    tick, time would run ahead until two ticks of the controller fall into one step.
    """
    root = etree.Element("OspSystemStructure", xmlns=_NAMESPACE, version="0.1")
    step = f"{math.floor(structure.step * NANOSECONDS + 1e-3) / NANOSECONDS:.9f}"
    etree.SubElement(root, "StartTime").text = "0"
    etree.SubElement(root, "BaseStepSize").text = step
    etree.SubElement(root, "Algorithm").text = "fixedStep"
    simulators = etree.SubElement(root, "Simulators")
    for part in structure.components:
        simulator = etree.SubElement(
            simulators, "Simulator", name=part.name, source=part.source, stepSize=step
        )
        values = etree.SubElement(simulator, "InitialValues")
        for start in structure.starts:
            if start.component == part.name:
                value = etree.SubElement(values, "InitialValue", variable=start.name)
                etree.SubElement(value, start.type, value=value_text(start))
    connections = etree.SubElement(root, "Connections")
    for ends in structure.connections:
        connection = etree.SubElement(connections, "VariableConnection")
        for simulator, name in ends:
            etree.SubElement(connection, "Variable", simulator=simulator, name=name)
    text: bytes = etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8")
    return text
