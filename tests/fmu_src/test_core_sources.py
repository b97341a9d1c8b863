"""The controller's sources as a part of other programs: headers alone, C++, names."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from compilers import CORE, CORE_FILES, STRICT, run, tool

from apnc_core.controller import Controller
from apnc_core.interface import Inputs

HEADERS = sorted(path.name for path in CORE.glob("*.h"))

CPLUSPLUS = """\
#include <cstdio>
#include "apnc.h"

int main() {
    apnc_data data;
    apnc_state state;
    apnc_defaults(&data);
    apnc_init(&data.parameters, &state, &data.outputs);
    for (int n = 0; n < 100; n++) {
        for (int leg = 0; leg < APNC_LEGS; leg++) data.inputs.grf[leg] = (n + leg) % 7;
        apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
    }
    for (double theta : data.outputs.theta_hip) std::printf("%a ", theta);
}
"""


@pytest.mark.parametrize("single", [(), ("-DAPNC_SINGLE",)], ids=["double", "float"])
@pytest.mark.parametrize("header", HEADERS)
def test_every_header_compiles_alone(header: str, single: tuple[str, ...], tmp_path: Path) -> None:
    source = tmp_path / "alone.c"
    # the second inclusion must be empty; the declaration keeps the unit from being so
    source.write_text(f'#include "{header}"\n#include "{header}"\ntypedef int declared;\n')
    command = [tool("cc", "gcc"), "-std=c11", *STRICT, "-Wdouble-promotion", *single]
    run(*command, f"-I{CORE}", "-c", source, "-o", tmp_path / "alone.o")


def test_headers_are_those_of_the_blocks() -> None:
    assert {"apnc.h", "load.h", "oscillator.h", "phase_estimation.h"} <= set(HEADERS)


def objects(folder: Path, *flags: str) -> list[Path]:
    """The compiled core."""
    made = []
    for path in CORE_FILES:
        made.append(folder / f"{path.stem}.o")
        run(tool("cc", "gcc"), "-std=c11", "-O2", *STRICT, *flags, "-c", path, "-o", made[-1])
    return made


@pytest.mark.parametrize("standard", ["c++11", "c++20"])
def test_a_cplusplus_program_runs_the_core(standard: str, tmp_path: Path) -> None:
    source, program = tmp_path / "main.cpp", tmp_path / "main"
    source.write_text(CPLUSPLUS)
    command = [tool("g++", "g++"), f"-std={standard}", *STRICT, f"-I{CORE}", source]
    run(*command, *objects(tmp_path), "-o", program, "-lm")
    controller = Controller()
    for n in range(100):
        out = controller.tick(Inputs([float((n + leg) % 7) for leg in range(4)]))  # type: ignore[arg-type]
    assert [float.fromhex(word) for word in run(program).split()] == out.theta_hip.tolist()


@pytest.mark.parametrize(
    ("flags", "prefix"),
    [((), "apnc4_"), (("-DAPNC_LEGS=6",), "apnc6_"), (("-DAPNC_SINGLE",), "apnc4f_")],
)
def test_every_name_of_the_core_carries_the_build(
    flags: tuple[str, ...], prefix: str, tmp_path: Path
) -> None:
    names = run(tool("nm", "binutils"), "-g", "--defined-only", *objects(tmp_path, *flags))
    defined = re.findall(r" [A-Z] (\w+)", names)
    assert sorted(defined) == [
        prefix + n for n in ("defaults", "init", "reset", "tick", "variables")
    ]
