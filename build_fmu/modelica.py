"""What the Modelica package ``modelica/Apnc`` takes from the table and from the C core.

``build_fmu.generate`` writes these files with the others; equations are written by hand.
"""

from __future__ import annotations

import importlib.resources
import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

from apnc_core import dual_rate_learner, forward_model, load, phase_reset
from apnc_core.schema import MAX_LEGS, Causality, Shape, Type, Variable
from apnc_core.variables import variables_of

PACKAGE: Final = "modelica/Apnc"

TARGETS: Final = {
    f"modelica_{template}.j2": f"{PACKAGE}/{path}"
    for template, path in {
        "types.mo": "Types.mo",
        "constants.mo": "Constants.mo",
        "parameters.mo": "Parameters.mo",
        "presets.mo": "Presets.mo",
        "variables.mo": "UsersGuide/Variables.mo",
        "interface.mo": "Interfaces/Controller.mo",
        "controller_c.mo": "Blocks/ControllerC.mo",
        "state.mo": "External/State.mo",
        "step.mo": "External/step.mo",
        "wrapper.h": "Resources/Include/apnc_modelica.h",
    }.items()
}
AMALGAMATION: Final = f"{PACKAGE}/Resources/Include/apnc_core.h"

REST: Final = "Rest"
"""Group of the parameters that no block below names."""

GROUPS: Final[dict[str, tuple[str, ...]]] = {
    "Sampling": ("Ts",),
    "Method": ("method",),
    "Commands": ("MI_zero_resets",),
    "FootLoad": ("robot_weight", "F_max"),
    "Oscillator": ("w11", "w12_0", "bias", "o1_start", "o2_start"),
    "MotorNeurons": ("a1", "a2", "b1", "b2", "turn_gain"),
    "SensoryFeedback": ("feedback_kept", "gamma_tegotae"),
    "DualRateLearner": ("A_f", "B_f", "A_s", "B_s"),
    "ForwardModel": ("alpha", "rho", "forward_model", "rbf_rate"),
    "TouchDown": ("grf_reset",),
    "PhaseAcquisition": ("phase_measure", "phase_filter"),
    "KappaRule": ("kappa_rule",),
    "PhaseEstimation": ("N", "sigma", "kappa_hold"),
    "NeuralCoupling": ("xi", "coupling_sign", "phi_frozen", "stored", "phi_stored"),
}
"""Parameters by the record that declares them; the blocks extend these records."""

QUANTITIES: Final = {"N": "Force", "rad": "Angle", "s": "Time"}
"""Modelica type of a unit; ``1`` and no unit are plain Real."""


def groups() -> dict[str, list[Variable]]:
    """Every parameter of the table by its record, in the order of ``GROUPS``.

    Raises:
        ValueError: a group names a parameter that the table does not have.
    """
    parameters = {v.name: v for v in variables_of(Causality.parameter)}
    named = [name for names in GROUPS.values() for name in names]
    if unknown := sorted(set(named) - set(parameters)):
        raise ValueError(f"the table has no parameter {', '.join(unknown)}")
    found = {group: [parameters[name] for name in names] for group, names in GROUPS.items()}
    rest = [v for name, v in parameters.items() if name not in named]
    return found | ({REST: rest} if rest else {})


def mo_type(v: Variable) -> str:
    """``Types.Angle``, ``Types.Method``, ``Integer``."""
    if v.enumeration:
        return f"Types.{v.enumeration.name}"
    if v.type is Type.real and v.unit in QUANTITIES:
        return f"Types.{QUANTITIES[v.unit]}"
    return v.type.value


def mo_value(v: Variable, value: Any) -> str:
    """``value`` as a Modelica literal."""
    if v.enumeration:
        return f"Types.{v.enumeration.name}.{v.enumeration.items(int(value)).name}"
    if v.type is Type.boolean:
        return str(bool(value)).lower()
    return str(int(value)) if v.type is Type.integer else repr(float(value))


def mo_size(v: Variable) -> str:
    """``[n]``, ``[n - 1]`` or nothing."""
    return {Shape.scalar: "", Shape.leg: "[n]", Shape.relation: "[n - 1]"}[v.shape]


def mo_attributes(v: Variable) -> str:
    """Modification with range, unit and start, or nothing."""
    found = []
    if v.type is Type.real and v.unit == "1":
        found.append('unit="1"')
    if v.type is Type.real and v.unit in QUANTITIES and v.causality is not Causality.parameter:
        found += [f'quantity="{QUANTITIES[v.unit]}"', f'unit="{v.unit}"']
    if v.display_unit:
        found.append(f'displayUnit="{v.display_unit}"')
    if v.min is not None and v.max is not None:
        found += [f"min={mo_value(v, v.min)}", f"max={mo_value(v, v.max)}"]
    if v.causality is Causality.input and v.start is not None:
        found.append(f"start={mo_value(v, v.start)}")
    each = "" if v.shape is Shape.scalar else "each "
    return f"({', '.join(each + x for x in found)})" if found else ""


def mo_default(v: Variable) -> str:
    """Default of a parameter; arrays are filled with it."""
    value = mo_value(v, v.start)
    return value if v.shape is Shape.scalar else f"fill({value}, {mo_size(v)[1:-1]})"


def mo_comment(v: Variable) -> str:
    """Description with its equation, as a Modelica string."""
    equation = f" (Eq. {v.equation})" if v.equation else ""
    return '"' + _quoted(v.description + equation) + '"'


def mo_connector(v: Variable) -> str:
    """``RealInput`` and so on; a local variable is none."""
    if v.causality is Causality.local:
        return v.type.value
    return f"{v.type.value}{v.causality.name.capitalize()}"


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def html(text: str) -> str:
    """Text for the documentation, which is HTML inside a Modelica string."""
    for sign, entity in (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;")):
        text = text.replace(sign, entity)
    return _quoted(text)


def html_value(v: Variable, value: Any) -> str:
    """Value in a table of the documentation."""
    if value is None:
        return ""
    return mo_value(v, value).rsplit("Types.", 1)[-1]


def c_argument(v: Variable) -> str:
    """Argument of the C wrapper, as the language specification maps the Modelica type."""
    scalar = "double" if v.type is Type.real else "int"
    if v.causality in (Causality.output, Causality.local):
        return f"{scalar} *{v.name}"
    return f"{scalar} {v.name}" if v.shape is Shape.scalar else f"const {scalar} *{v.name}"


def amalgamation(generated: Mapping[str, str]) -> str:
    """The C core as one header without external names, which a tool may include where it likes.

    Local includes are put in their place once; functions and tables become static, because some
    tools include the header in several translation units of one model.

    Args:
        generated: text of the files of the core that are generated too, by path in the project.
    """
    core = importlib.resources.files("fmu_src").joinpath("core")
    seen: set[str] = set()

    def inlined(name: str) -> Iterator[str]:
        if name in seen:
            return
        seen.add(name)
        text = generated.get(f"fmu_src/core/{name}")
        text = text or core.joinpath(name).read_text(encoding="utf-8")
        for line in text.splitlines():
            local = re.match(r'#include "(.+)"', line)
            if local:
                yield from inlined(local[1])
            else:
                yield line

    text = "\n".join([*inlined("controller.c"), *inlined("apnc_variables.c")])
    text = re.sub(r"^(?=(?:void|int|double) apnc_\w+\()", "static ", text, flags=re.MULTILINE)
    text = re.sub(
        r"^(extern )?const apnc_variable", "static const apnc_variable", text, flags=re.MULTILINE
    )
    return (
        "/* The C core of the controller in one file.\n *\n"
        " * Generated from fmu_src/core by `python -m build_fmu.generate`; do not edit.\n */\n"
        f"#ifndef APNC_CORE_H\n#define APNC_CORE_H\n\n{text}\n\n#endif\n"
    )


FILTERS: Final[dict[str, Callable[..., str]]] = {
    "mo_type": mo_type,
    "mo_size": mo_size,
    "mo_attributes": mo_attributes,
    "mo_default": mo_default,
    "mo_comment": mo_comment,
    "mo_connector": mo_connector,
    "html": html,
    "html_value": html_value,
    "c_argument": c_argument,
}


def context() -> dict[str, Any]:
    """What the templates of the package need beside the table."""
    first, second = phase_reset.ACTIVATION_AT_TOUCH_DOWN
    return {
        "parameter_groups": groups(),
        "quantities": {name: unit for unit, name in QUANTITIES.items()},
        "paper_modifications": [
            f"{v.name}={mo_value(v, v.paper)}"
            for v in variables_of(Causality.parameter)
            if v.paper is not None
        ],
        "constants": [
            ("MOST_WEIGHTS", load.MOST_WEIGHTS, "a load above so many times the weight is none"),
            ("FORGOTTEN", dual_rate_learner.FORGOTTEN, "gains below this count as zero"),
            ("A1_AT_TOUCH_DOWN", first, "activation a1 that touch-down sets (phase_reset)"),
            ("A2_AT_TOUCH_DOWN", second, "activation a2 that touch-down sets (phase_reset)"),
            ("KERNEL_WIDTH", forward_model.KERNEL_WIDTH, "distance squared of a kernel's 1/e"),
            (
                "OVERLAP",
                forward_model.OVERLAP,
                "mean of the kernels' sum over the angle of the cycle",
            ),
            *(
                (
                    f"CENTRES_{i + 1}[KERNELS]",
                    "{" + ", ".join(repr(c[i]) for c in forward_model.CENTRES) + "}",
                    f"kernels' centres along o{i + 1}",
                )
                for i in range(2)
            ),
        ],
        "kernels": forward_model.KERNELS,
        "legs_max": MAX_LEGS,
    }
