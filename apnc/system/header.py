"""A system as a C header, for programs that read no XML."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Final

from apnc.system.structure import Component, Structure
from apnc_core.schema import Type
from build_fmu.description_parts import number
from build_fmu.platforms import PLATFORMS

HEADER_FILE: Final = "system.h"

_TYPES: Final = {Type.real: "double", Type.integer: "int", Type.boolean: "int"}
"""Types of start values in FMI, and in C."""

_CONDITIONS: Final = {
    "win64": "defined _WIN32",
    "darwin64": "defined __APPLE__",
    "aarch64-linux": "defined __aarch64__",
}
"""Condition of the preprocessor by platform. If none holds, it is Linux on x86-64."""

_STRUCT: Final = """
/* An FMU: its connections, from outputs of the other one to its inputs, and its start values. */
struct system_fmu {
    const char *model, *guid;
    size_t inputs;
    const unsigned *from, *to;
    size_t reals;
    const unsigned *real;
    const double *real_values;
    size_t integers;
    const unsigned *integer;
    const int *integer_values;
    size_t booleans;
    const unsigned *boolean;
    const int *boolean_values;
};
"""


def header(structure: Structure, guids: Mapping[str, str]) -> bytes:
    """``system.h``: models, guids, connections and start values, by value reference.

    Args:
        structure: the system.
        guids: of its FMUs, by the name of the component.
    """
    controller, plant = structure.components
    lines = [
        f"/* System {structure.name} for a program that reads no XML, by value reference. It fits",
        " * the FMUs that were written with it, and no others. */",
        "#ifndef SYSTEM_H",
        "#define SYSTEM_H",
        "",
        "#include <stddef.h>",
        "",
        f"#define SYSTEM_STEP {structure.step!r} /* [s] */",
        "",
        "/* Path of a library: folder of the system, model, model. */",
        *_libraries(),
        "",
        f"enum {{ SYSTEM_LEGS = {len(structure.legs)} }};",
        f"static const char *const system_legs[] = {_list(map(_quoted, structure.legs))};",
        "",
        "/* What the FMUs show. */",
        "enum {",
        *_shown(controller),
        *_shown(plant),
        "};",
        *_STRUCT.splitlines(),
        "",
        "/* In the order in which a loop steps them. */",
        f"enum {{ {controller.name.upper()}, {plant.name.upper()} }};",
        "static const struct system_fmu system_fmus[] = {",
        *_fmu(structure, controller, plant, guids[controller.name]),
        *_fmu(structure, plant, controller, guids[plant.name]),
        "};",
        "",
        "#endif",
        "",
    ]
    return "\n".join(lines).encode()


def _libraries() -> list[str]:
    lines: list[str] = []
    for name, condition in _CONDITIONS.items():
        lines += [f"#{'elif' if lines else 'if'} {condition}", _library(name)]
    return [*lines, "#else", _library("linux64"), "#endif"]


def _library(platform: str) -> str:
    place = f"%s/resources/%s/binaries/{platform}/%s{PLATFORMS[platform].suffix}"
    return f'#define SYSTEM_LIBRARY "{place}"'


def _shown(part: Component) -> list[str]:
    return [
        f"    {part.name}_{_identifier(c.name)} = {c.reference}, "
        f"/* {c.kind}{f' [{c.unit}]' if c.unit else ''} */"
        for c in part.connectors
    ]


def _fmu(structure: Structure, part: Component, other: Component, guid: str) -> list[str]:
    ends = [
        (f"{start[0]}_{_identifier(start[1])}", f"{end[0]}_{_identifier(end[1])}")
        for start, end in structure.connections
        if (start[0], end[0]) == (other.name, part.name)
    ]
    lines = [
        f"    {{.model = {_quoted(part.model)},",
        f"     .guid = {_quoted(guid)},",
        f"     .inputs = {len(ends)},",
        f"     .from = {_array('unsigned', (start for start, _ in ends))},",
        f"     .to = {_array('unsigned', (end for _, end in ends))},",
    ]
    for kind, c_type in _TYPES.items():
        starts = [s for s in structure.starts if s.component == part.name and s.type == kind]
        references = (f"{s.reference} /* {s.name} */" for s in starts)
        values = (number(int(s.value) if kind is not Type.real else s.value) for s in starts)
        lines += [
            f"     .{kind.name}s = {len(starts)},",
            f"     .{kind.name} = {_array('unsigned', references)},",
            f"     .{kind.name}_values = {_array(c_type, values)},",
        ]
    return [*lines[:-1], lines[-1].removesuffix(",") + "},"]


def _array(c_type: str, entries: Iterable[str]) -> str:
    known = list(entries)
    return f"(const {c_type}[]){_list(known)}" if known else "NULL"


def _list(entries: Iterable[str]) -> str:
    return f"{{{', '.join(entries)}}}"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", r"\\").replace('"', r"\"")
    return f'"{escaped}"'


def _identifier(name: str) -> str:
    """``leg1_grf`` for ``leg[1].grf``."""
    return re.sub(r"\W+", "_", name.replace("[", "").replace("]", ""))
