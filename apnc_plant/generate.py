"""Writes the files that are made from the table of variables of a robot's FMU.

``python -m apnc_plant.generate`` writes them; ``outdated()`` names those that differ from the
table, which a test checks.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

from apnc_core.schema import VR_STRIDE, Causality, Shape, Type, Variable
from apnc_plant.variable_numbers import VARIABLE_NUMBERS
from apnc_plant.variables import ENUMERATIONS, TABLE, is_of_robot
from build_fmu.generate import PAGE_FILTERS, c_unit, limits, numbers_of, snake

ROOT: Final = Path(__file__).resolve().parent.parent

TARGETS: Final = {
    "plant_variables.h.j2": "fmu_src/fmi/plant_variables.h",
    "plant_variables.c.j2": "fmu_src/fmi/plant_variables.c",
    "variable_numbers.py.j2": "apnc_plant/variable_numbers.py",
    "plant_variables.md.j2": "docs/plant_variables.md",
}

_C_GROUP: Final = {
    Causality.input: "inputs",
    Causality.output: "outputs",
    Causality.parameter: "parameters",
}


def start_macro(v: Variable) -> str:
    """Macro that holds the start value of a variable which is a number of the robot."""
    return f"ROBOT_{v.identifier.upper()}"


def _c_start(v: Variable) -> str:
    own = v.causality is Causality.parameter and is_of_robot(v)
    return start_macro(v) if own else repr(float(v.start or 0.0))


def _md_start(v: Variable) -> str:
    if v.causality is not Causality.parameter:
        return ""
    if is_of_robot(v):
        return "the robot's"
    return v.enumeration.items(int(v.start or 0)).name if v.enumeration else f"{v.start:g}"


def _c_field(v: Variable) -> str:
    size = "[APNC_LEGS]" if v.shape is Shape.leg else ""
    return f"{'double' if v.type is Type.real else 'int32_t'} {v.identifier}{size}"


def _c_variable(v: Variable | None) -> str:
    """Initialiser of one element of ``apnc_variables``; a removed variable has no entries."""
    if v is None:
        return '{"", "", "", 0, 0, APNC_REAL, APNC_LOCAL, 0.0, 1.0, -1.0}'
    several = v.shape is Shape.leg
    role = v.variability if v.causality is Causality.parameter else v.causality.name
    low, high = map(float, limits(v))
    return (
        f'{{"{v.name}", {"LEG" if several else "ONE"}("{v.name}", "{v.identifier}"), '
        f"AT({_C_GROUP[v.causality]}, {v.identifier}), {'APNC_LEGS' if several else 1}, "
        f"APNC_{v.type.name.upper()}, APNC_{role.upper()}, {_c_start(v)}, {low!r}, {high!r}}}"
    )


def render() -> dict[str, str]:
    """Text of every generated file by its path from the project's root."""
    env = Environment(
        loader=ChoiceLoader([PackageLoader("apnc_plant"), PackageLoader("build_fmu")]),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        autoescape=False,
    )
    numbers, known = numbers_of(TABLE, VARIABLE_NUMBERS), {v.name: v for v in TABLE}
    env.filters |= PAGE_FILTERS | {
        "md_start": _md_start,
        "md_reference": lambda v: VR_STRIDE * numbers[v.name],
        "c_field": _c_field,
        "c_variable": _c_variable,
        "c_unit": c_unit,
        "c_snake": snake,
        "c_const": lambda name: snake(name).upper(),
    }
    of = {c: [v for v in TABLE if v.causality is c] for c in Causality}
    context = {
        "command": "apnc_plant.generate",
        "numbers": numbers,
        "table": [known.get(name) for name in numbers],
        "enumerations": ENUMERATIONS,
        "groups": [
            ("Inputs", of[Causality.input]),
            ("Outputs", of[Causality.output]),
            ("Parameters", of[Causality.parameter]),
        ],
        "structs": [
            ("plant_parameters", "Parameters.", of[Causality.parameter]),
            ("plant_inputs", "Inputs of one step.", of[Causality.input]),
            ("plant_outputs", "Outputs after a step.", of[Causality.output]),
        ],
    }
    return {path: env.get_template(name).render(context) for name, path in TARGETS.items()}


def outdated(root: Path = ROOT) -> list[str]:
    """Generated files under ``root`` whose text is not what the table gives now."""
    return [
        path
        for path, text in render().items()
        if not (root / path).is_file() or (root / path).read_text(encoding="utf-8") != text
    ]


def main() -> None:
    """Write every generated file into the source tree."""
    for path, text in render().items():
        (ROOT / path).write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
