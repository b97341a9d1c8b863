"""Several builds in one program, as hardware-in-the-loop tools link them."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from compilers import NATIVE, SANITIZERS, STRICT, run, tool
from native_driver import load

from apnc.loop.fmu_controller import FmuController
from apnc_core.variables import scalars
from build_fmu import sources
from build_fmu.build import host_fmu
from build_fmu.options import BuildOptions

BUILDS = [(4, 2), (6, 2), (4, 3), (6, 3)]
TICKS, TS = 600, 1 / 60
HIP = next(s.value_reference for s in scalars() if s.variable.name == "theta_hip")
MAIN = """\
#include <stdio.h>
{declarations}
int main(void) {{
    return {calls};
}}
"""


def prefix(legs: int, fmi: int) -> str:
    return f"legs{legs}fmi{fmi}_"


def compile_build(legs: int, fmi: int, folder: Path, *flags: str) -> list[Path]:
    """Objects of one build and of its driver, functions of the standard prefixed."""
    folder.mkdir()
    options = BuildOptions(legs=legs, platforms=(), fmi=fmi)
    files = sources.collect(fmi)
    files["apnc_config.h"] = sources.config_header(options, sources.guid_of(repr(options).encode()))
    for name, text in files.items():
        (folder / name).write_bytes(text)
    define = f"-DFMI{fmi}_FUNCTION_PREFIX={prefix(legs, fmi)}"
    made = []
    for source in [folder / n for n in sources.c_files(files)] + [NATIVE / f"static{fmi}.c"]:
        made.append(folder / f"{source.stem}.o")
        command = [tool("gcc", "gcc"), "-std=c11", *STRICT, "-Wno-unused-function", *flags]
        command += ["-D_GNU_SOURCE", define, f"-I{folder}", f"-I{NATIVE}", "-c", str(source)]
        run(*command, "-o", made[-1])
    return made


def compile_all(folder: Path, *flags: str) -> dict[tuple[int, int], list[Path]]:
    """Objects of every build."""
    return {build: compile_build(*build, folder / prefix(*build), *flags) for build in BUILDS}


def expected(legs: int) -> np.ndarray:
    """Hip commands of the shared library over the loads of the driver, shape (ticks, legs)."""
    seed, rows = 1, []
    with FmuController(host_fmu(legs)) as fmu:
        for tick in range(TICKS):
            loads = np.empty(legs)
            for foot in range(legs):
                seed, loads[foot] = load(seed, tick, foot)
            fmu.step(tick * TS, TS, loads, 0.08, 0.0, False)
            rows.append(fmu.theta_hip.copy())
    return np.array(rows)


@pytest.mark.thorough
def test_four_builds_in_one_program_give_what_each_gives_alone(tmp_path: Path) -> None:
    names = [f"{prefix(*build)}run" for build in BUILDS]
    main = tmp_path / "main.c"
    main.write_text(
        MAIN.format(
            declarations="\n".join(f"int {name}(long, unsigned);" for name in names),
            calls=" || ".join(f"{name}({TICKS}, {HIP})" for name in names),
        )
    )
    every = [path for made in compile_all(tmp_path, *SANITIZERS).values() for path in made]
    run(tool("gcc", "gcc"), *SANITIZERS, main, *every, "-o", tmp_path / "main", "-lm")
    lines = run(tmp_path / "main").splitlines()
    for legs, _ in BUILDS:
        part, lines = lines[:TICKS], lines[TICKS:]
        bits = np.array([[int(word, 16) for word in line.split()] for line in part], np.uint64)
        np.testing.assert_array_equal(bits.view(float), expected(legs))
    assert lines == []


def test_no_name_is_shared_and_every_name_is_prefixed(tmp_path: Path) -> None:
    seen: Counter[str] = Counter()
    for build, made in compile_all(tmp_path, "-O0").items():
        text = run(tool("nm", "binutils"), "-g", "--defined-only", *made)
        names = re.findall(r"^\w+ [A-Z] (\w+)$", text, re.MULTILINE)
        functions = [name for name in names if "fmi" in name]
        assert functions and all(name.startswith(prefix(*build)) for name in functions)
        assert all(re.match(r"apnc_[0-9a-f]{8}_", n) for n in set(names) - set(functions))
        seen.update(names)
    assert {name for name, count in seen.items() if count > 1} == set()
