"""A system as the description that fmu-manipulation-toolbox makes one FMU of."""

from __future__ import annotations

import json
from typing import Final

from apnc.system.ssp import value_text
from apnc.system.structure import Structure
from apnc_core.schema import Causality

CONTAINER_FILE: Final = "container.json"


def container(structure: Structure) -> bytes:
    """container.json: both FMUs one after the other, as on the robot, with their start values.

    The tool reads an SSP too, but leaves out its start values and steps its FMUs side by side.
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
