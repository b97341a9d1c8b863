"""Writes the files that are generated from the table of variables.

``python -m build_fmu.generate`` writes them; ``outdated()`` names those that differ from the
table, which a test checks.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Final

from jinja2 import Environment, PackageLoader, StrictUndefined

from apnc_core import forward_model
from apnc_core.enumerations import ENUMERATIONS
from apnc_core.schema import MAX_LEGS, VR_STRIDE, VR_TIME, Causality, Shape, Type, Variable
from apnc_core.variable_numbers import VARIABLE_NUMBERS
from apnc_core.variables import N_WINDOW_MAX, TABLE, variables_of
from build_fmu import modelica

ROOT: Final = Path(__file__).resolve().parent.parent

TARGETS: Final = {
    "interface.py.j2": "apnc_core/interface.py",
    "apnc_variable.h.j2": "fmu_src/core/apnc_variable.h",
    "apnc_variables.h.j2": "fmu_src/core/apnc_variables.h",
    "apnc_variables.c.j2": "fmu_src/core/apnc_variables.c",
    "variables.md.j2": "docs/variables.md",
    "variable_numbers.py.j2": "apnc_core/variable_numbers.py",
    **modelica.TARGETS,
}

_C_GROUP: Final = {
    Causality.input: "inputs",
    Causality.output: "outputs",
    Causality.local: "outputs",
    Causality.parameter: "parameters",
}
_PYTHON_SCALAR: Final = {Type.real: "float", Type.integer: "int", Type.boolean: "bool"}


def python_type(v: Variable) -> str:
    """Annotation of the field in ``apnc_core/interface.py``."""
    if v.shape is not Shape.scalar:
        if v.causality is Causality.parameter:
            return "tuple[float, ...]"
        return "NDArray[np.bool_]" if v.type is Type.boolean else "Array"
    if v.enumeration:
        return v.enumeration.name
    return _PYTHON_SCALAR[v.type]


def python_start(v: Variable) -> str:
    """Default of the field in ``apnc_core/interface.py``."""
    if v.shape is not Shape.scalar:
        return "()"
    if v.enumeration:
        return f"{v.enumeration.name}.{v.enumeration.items(int(v.start or 0)).name}"
    return repr(v.start)


def doc(v: Variable) -> str:
    """Description with shape, unit and range, wrapped for a docstring."""
    shape = {Shape.scalar: "", Shape.leg: "shape (n,)", Shape.relation: "shape (n - 1,)"}[v.shape]
    if v.shape is Shape.relation and v.causality is Causality.parameter:
        shape = "n - 1 values, or empty for zeros"
    unit = f"[{v.unit}]" if v.unit and v.unit != "1" else ""
    extras = [x for x in (unit, shape, f"Eq. {v.equation}" if v.equation else "") if x]
    text = v.description + (f" ({', '.join(extras)})." if extras else ".")
    return _wrap(text, first=100 - 10 - len(v.name), rest=88)


def _wrap(text: str, first: int, rest: int) -> str:
    lines, width = [""], first
    for word in text.split():
        if len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
            width = rest
        lines[-1] = f"{lines[-1]} {word}".strip()
    return ("\n" + " " * 12).join(lines)


def c_type(name: str) -> str:
    """``KappaRule`` -> ``apnc_kappa_rule``."""
    return f"apnc_{snake(name)}"


def snake(name: str) -> str:
    """``KappaRule`` -> ``kappa_rule``."""
    return "".join(f"_{c.lower()}" if c.isupper() else c for c in name).removeprefix("_")


def c_field(v: Variable) -> str:
    """Struct member: int32_t for everything that is not Real, so that layouts agree everywhere."""
    size = {Shape.scalar: "", Shape.leg: "[APNC_LEGS]", Shape.relation: "[APNC_RELATIONS]"}[v.shape]
    return f"{'apnc_real' if v.type is Type.real else 'int32_t'} {v.name}{size}"


def c_unit(v: Variable) -> str:
    """Unit and equation in front of the comment on a struct member."""
    unit = f"[{v.unit}] " if v.unit else ""
    return unit + (f"Eq. {v.equation}: " if v.equation else "")


def c_variable(v: Variable | None) -> str:
    """Initialiser of one element of ``apnc_variables``; a removed variable has no entries."""
    if v is None:
        return '{"", "", "", 0, 0, APNC_REAL, APNC_LOCAL, 0.0, 1.0, -1.0}'
    names = {Shape.scalar: f'"{v.name}", ""', Shape.leg: f'LEG("{v.name}")'}
    names[Shape.relation] = f'RELATION("{v.name}")'
    count = {Shape.scalar: "1", Shape.leg: "APNC_LEGS", Shape.relation: "APNC_RELATIONS"}
    role = v.causality.name
    if v.causality is Causality.parameter:
        role = v.variability
    low, high = limits(v)
    values = ", ".join(repr(float(x)) for x in (v.start or 0.0, low, high))
    return (
        f'{{"{v.name}", {names[v.shape]}, AT({_C_GROUP[v.causality]}, {v.name}), '
        f"{count[v.shape]}, APNC_{v.type.name.upper()}, APNC_{role.upper()}, {values}}}"
    )


def variable_numbers() -> dict[str, int]:
    """Numbers of the variables of the controller."""
    return numbers_of(TABLE, VARIABLE_NUMBERS)


def numbers_of(table: Iterable[Variable], given: Mapping[str, int]) -> dict[str, int]:
    """Numbers of variables: those that were given once stay, a new variable gets the next one."""
    numbers = dict(given)
    for v in table:
        numbers.setdefault(v.name, len(numbers))
    return numbers


def limits(v: Variable) -> tuple[float, float]:
    """Inclusive range, or (1, -1) for a variable without one."""
    if v.enumeration:
        return 1.0, float(len(v.enumeration.items))
    if v.type is Type.boolean:
        return 0.0, 1.0
    if v.min is None or v.max is None:
        return 1.0, -1.0
    return v.min, v.max


def _md_start(v: Variable) -> str:
    if v.start is None:
        return ""
    values = [v.start] if v.paper is None else [v.start, v.paper]
    if v.enumeration:
        return " / ".join(v.enumeration.items(int(x)).name for x in values)
    return " / ".join(str(x).lower() if isinstance(x, bool) else f"{x:g}" for x in values)


def _md_range(v: Variable) -> str:
    if v.min is None or v.max is None:
        return ""
    return f"{v.min} ... {v.max}" if v.type is Type.integer else f"{v.min:g} ... {v.max:g}"


def _md_type(v: Variable) -> str:
    kind = v.enumeration.name if v.enumeration else v.type.value
    return f"{kind}, {v.variability}" if v.causality is Causality.parameter else kind


def _md_unit(v: Variable) -> str:
    return f"{v.unit} ({v.display_unit})" if v.display_unit else v.unit or ""


def _md_entries(v: Variable) -> str:
    return {Shape.scalar: "", Shape.leg: "per leg", Shape.relation: "per relation"}[v.shape]


PAGE_FILTERS: Final = {
    "md_entries": _md_entries,
    "md_range": _md_range,
    "md_type": _md_type,
    "md_unit": _md_unit,
}
"""Filters of the pages that list variables."""


def _environment() -> Environment:
    env = Environment(
        loader=PackageLoader("build_fmu"),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        autoescape=False,
    )
    env.filters |= {
        "python_type": python_type,
        "python_start": python_start,
        "doc": doc,
        "c_type": c_type,
        "c_const": lambda name: c_type(name).upper(),
        "c_field": c_field,
        "c_unit": c_unit,
        "c_variable": c_variable,
        **PAGE_FILTERS,
        "md_start": _md_start,
        "md_reference": lambda v: VR_STRIDE * variable_numbers()[v.name],
        **modelica.FILTERS,
    }
    return env


def render() -> dict[str, str]:
    """Text of every generated file by its path from the project's root."""
    inputs, parameters = variables_of(Causality.input), variables_of(Causality.parameter)
    outputs, local = variables_of(Causality.output), variables_of(Causality.local)
    numbers, known = variable_numbers(), {v.name: v for v in TABLE}
    context = {
        "command": "build_fmu.generate",
        "numbers": numbers,
        "table": [known.get(name) for name in numbers],
        "inputs": inputs,
        "parameters": parameters,
        "outputs": outputs + local,
        "enumerations": ENUMERATIONS,
        "structs": [
            ("apnc_parameters", "Parameters.", parameters),
            ("apnc_inputs", "Inputs of one tick.", inputs),
            ("apnc_outputs", "Outputs and local variables of one tick.", outputs + local),
        ],
        "groups": [
            ("Inputs", inputs),
            ("Outputs", outputs),
            ("Parameters", parameters),
            ("Local variables", local),
        ],
        "limited": [v for v in inputs if v.min is not None],
        "max_legs": MAX_LEGS,
        "window_max": N_WINDOW_MAX,
        "centres": forward_model.CENTRES,
        "kernel_width": forward_model.KERNEL_WIDTH,
        "overlap": forward_model.OVERLAP,
        "vr_stride": VR_STRIDE,
        "vr_time": VR_TIME,
        **modelica.context(),
    }
    env = _environment()
    files = {path: env.get_template(name).render(context) for name, path in TARGETS.items()}
    return files | {modelica.AMALGAMATION: modelica.amalgamation(files)}


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
