"""A system as the description from which fmu-manipulation-toolbox makes one FMU."""

from __future__ import annotations

import json
from typing import Final

from apnc.system.ssp import value_text
from apnc.system.structure import Structure
from apnc_core.schema import Causality

CONTAINER_FILE: Final = "container.json"


def container(structure: Structure) -> bytes:
    """Content of container.json: both FMUs, stepped one after the other, and their start values.

    The tool also reads an SSP archive, but it ignores the start values there and steps the FMUs in
    parallel.
    """
    source = {part.name: part.source for part in structure.components}
    description = {
        "name": f"{structure.name}System.fmu",
        "sequential": True,
        **dict.fromkeys(("auto_link", "auto_input", "auto_output", "auto_parameter"), False),
        "step_size": structure.step,
        "fmu": list(source.values()),
        "output": [
            [part.source, c.name, c.name]
            for part in structure.components
            for c in part.connectors
            if c.kind == Causality.output
        ],
        "link": [
            [source[start], output, source[end], entry]
            for (start, output), (end, entry) in structure.connections
        ],
        "start": [[source[s.component], s.name, value_text(s)] for s in structure.starts],
    }
    return json.dumps(description, indent=1).encode() + b"\n"
