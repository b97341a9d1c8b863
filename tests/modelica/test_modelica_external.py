"""The external controller: its C functions compiled as a tool would, and called.

No compiler of Modelica at hand links external C, so the calls that ``External.State`` and
``External.step`` declare are made from C here.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from apnc_core.controller import Controller
from apnc_core.enumerations import Method
from apnc_core.interface import Inputs, Parameters
from apnc_core.schema import Causality, Shape, Type, Variable
from apnc_core.variables import TABLE, variables_of

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "modelica" / "Apnc"
INCLUDE = PACKAGE / "Resources" / "Include"
NATIVE = Path(__file__).parent / "native"
TICKS = 1000
RESULTS = tuple(
    v for v in variables_of(Causality.output) + variables_of(Causality.local) if v.name != "tick"
)
PARAMETERS = variables_of(Causality.parameter)


def c_type(v: Variable) -> str:
    return "double" if v.type is Type.real else "int"


def size(v: Variable, n_legs: int) -> str:
    return "" if v.shape is Shape.scalar else f"[{v.count(n_legs)}]"


def c_value(v: Variable, value: object, n_legs: int) -> str:
    if v.shape is Shape.scalar:
        return real(value) if v.type is Type.real else str(int(value))  # type: ignore[call-overload]
    return "{" + ", ".join(map(real, value or [0.0] * v.count(n_legs))) + "}"  # type: ignore[call-overload]


def real(value: float) -> str:
    return repr(float(value)) if value == value else "NAN"


def program(p: Parameters, n_legs: int, n: int, again: bool) -> str:
    """A program that reads loads, MI, turn and reset per tick and prints the results."""
    values = {v.name: getattr(p, v.name) for v in PARAMETERS}
    declared = [
        f"{c_type(v)} {v.name}{size(v, n_legs)} = {c_value(v, values[v.name], n_legs)};"
        for v in PARAMETERS
    ] + [f"{c_type(v)} {v.name}{size(v, n_legs)};" for v in RESULTS]
    new = ", ".join(v.name for v in PARAMETERS)
    given = ", ".join(v.name for v in variables_of(Causality.input))
    refs = ", ".join(("&" if v.shape is Shape.scalar else "") + v.name for v in RESULTS)
    shown = "\n".join(
        f'for (int i = 0; i < {v.count(n_legs)}; i++) printf("%.17g ", '
        f"(double){v.name}{'' if v.shape is Shape.scalar else '[i]'});"
        for v in RESULTS
    )
    step = f"apnc_modelica_step(state, k, {given}, {refs});"
    return f"""
#include <math.h>
#include <stdio.h>
#include "apnc_modelica.h"
int main(void) {{
    {" ".join(declared)}
    double grf[{n_legs}], MI, turn;
    int reset;
    void *state = apnc_modelica_new({n}, {new});
    for (int k = 1;; k++) {{
        for (int i = 0; i < {n_legs}; i++) if (scanf("%lf", &grf[i]) != 1) goto done;
        if (scanf("%lf %lf %d", &MI, &turn, &reset) != 3) goto done;
        {step if again else ""}
        {step}
        {shown}
        puts("");
    }}
done:
    apnc_modelica_free(state);
    return 0;
}}
"""


def build(folder: Path, text: str, n_legs: int = 4) -> Path:
    (folder / "main.c").write_text(text)
    # some tools include the header in several translation units of one model
    (folder / "second.c").write_text(
        '#include "apnc_modelica.h"\nvoid *second(void);\n'
        "void *second(void) { return (void *)apnc_modelica_free; }\n"
    )
    command = [sys.executable, "-m", "ziglang", "cc", "-std=c11", "-O2", "-ffp-contract=off"]
    command += ["-Wall", "-Wextra", "-Werror", "-Wno-unused-function", f"-DAPNC_LEGS={n_legs}"]
    command += [f"-I{INCLUDE}", f"-I{NATIVE}", "main.c", "second.c", "-o", "main", "-lm"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder / "main"


def given(n_legs: int) -> list[Inputs]:
    rng = np.random.default_rng(3)
    t = np.arange(TICKS) / 60
    phase = 3.0 * np.arange(n_legs)
    loads = 12.0 * (0.48 + 0.5 * np.sin(10.0 * t[:, None] + phase)) + rng.normal(0, 0.3, n_legs)
    loads[50] = np.nan
    MI = 0.1 + 0.05 * np.sin(0.3 * t)
    turn = 1.2 * np.sin(0.5 * t)
    return [Inputs(loads[n], MI[n], turn[n], 480 <= n < 485) for n in range(TICKS)]


@pytest.mark.parametrize(
    ("method", "n_legs", "again"),
    [*((m, 4, False) for m in Method), (Method.apnc, 6, False), (Method.apnc, 4, True)],
    ids=[*(m.name for m in Method), "six legs", "every tick twice"],
)
def test_c_functions_equal_the_reference(
    method: Method, n_legs: int, again: bool, tmp_path: Path
) -> None:
    p = Parameters(method=method, kappa_hold=10, sigma=1.0)
    main = build(tmp_path, program(p, n_legs, n_legs, again), n_legs)
    ticks = given(n_legs)
    text = "\n".join(
        " ".join([*map(repr, map(float, now.grf)), repr(float(now.MI)), repr(float(now.turn))])
        + f" {int(now.reset)}"
        for now in ticks
    )
    done = subprocess.run([str(main)], input=text, capture_output=True, text=True, check=True)
    got = np.array([line.split() for line in done.stdout.splitlines()], dtype=float)
    reference = Controller(p, n_legs)
    expected = []
    for now in ticks:
        o = reference.tick(now)
        parts = [np.atleast_1d(np.asarray(getattr(o, v.name), dtype=float)) for v in RESULTS]
        expected.append(np.concatenate(parts))
    assert np.isfinite(got).all()
    assert np.abs(got - np.array(expected)).max() <= 1e-9


@pytest.mark.parametrize(
    ("changes", "n", "message"),
    [
        ({}, 6, "Apnc: n = 6, but the C core is compiled for 4 legs (APNC_LEGS)"),
        ({"N": 300}, 4, "Apnc: N = 300 is not in 1 ... 256"),
        ({"rho": float("nan")}, 4, "Apnc: rho = nan is not in 0 ... 1"),
    ],
    ids=["legs", "window", "not a number"],
)
def test_what_the_core_cannot_take_is_one_line(
    changes: dict[str, float], n: int, message: str, tmp_path: Path
) -> None:
    p = Parameters(**changes)  # type: ignore[arg-type]
    main = build(tmp_path, program(p, 4, n, False))
    done = subprocess.run([str(main)], input="", capture_output=True, text=True, check=False)
    assert done.returncode == 3
    assert done.stderr == message


def arguments(text: str, call: str) -> list[str]:
    found = re.search(rf"{call}\(([^)]*)\)", text)
    assert found
    names = [name.split()[-1].lstrip("*") for name in found[1].split(",")]
    return ["state" if name == "memory" else name for name in names]


@pytest.mark.parametrize(
    ("file", "function"), [("State.mo", "apnc_modelica_new"), ("step.mo", "apnc_modelica_step")]
)
def test_modelica_calls_c_with_the_arguments_it_takes(file: str, function: str) -> None:
    header = (INCLUDE / "apnc_modelica.h").read_text()
    call = (PACKAGE / "External" / file).read_text()
    declared, called = arguments(header, function), arguments(call, function)
    assert declared == called
    assert set(called) - {"state", "k", "n"} <= {v.name for v in TABLE}


@pytest.mark.parametrize(
    ("compiler", "standard", "taken"),
    [("cc", "c99", True), ("cc", "c89", False), ("c++", "c++17", False)],
)
def test_the_header_is_c99_and_not_cpp(
    compiler: str, standard: str, taken: bool, tmp_path: Path
) -> None:
    """So says docs/modelica.md."""
    name = "only.c" if compiler == "cc" else "only.cpp"
    (tmp_path / name).write_text('#include "apnc_modelica.h"\n')
    command = [sys.executable, "-m", "ziglang", compiler, f"-std={standard}", "-pedantic-errors"]
    command += [f"-I{INCLUDE}", f"-I{NATIVE}", "-c", name, "-o", "only.o"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode == 0) == taken, done.stderr
