"""The core outside an FMU: single precision, a bare Cortex-M, CMake, a loop on Linux.

``data/loads_of_a_walk.npz`` holds the foot loads [0.01 N], shape (ticks, 4), that `apnc walk --mi
0.08 --duration 60` recorded.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from compilers import CORE, CORE_FILES, NATIVE, STRICT, run, tool

LOADS = np.load(Path(__file__).parent / "data" / "loads_of_a_walk.npz")["loads"]
TROT = (np.pi, np.pi, 0.0)
FMU_SRC = CORE.parent


@dataclass(frozen=True)
class Replay:
    """What replay.c printed: commands (ticks, 8), stored phases (ticks, 3), kappa (ticks,)."""

    theta: np.ndarray
    phi_memory: np.ndarray
    kappa: np.ndarray
    instructions: int
    counted: int
    state: int
    variables: int


def parse(text: str) -> Replay:
    *lines, figures = text.splitlines()
    values = np.array([line.split() for line in lines], dtype=float)
    return Replay(
        values[:, :8], values[:, 8:11], values[:, 11], *(int(word) for word in figures.split())
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where programs are built, with the loads as a header."""
    folder = tmp_path_factory.mktemp("robot")
    rows = ",\n".join("{" + ", ".join(map(str, row)) + "}" for row in LOADS.tolist())
    (folder / "loads.h").write_text(
        f"#define TICKS {len(LOADS)}\nstatic const int16_t loads[TICKS][4] = {{{rows}}};\n"
    )
    return folder


def on_this_machine(folder: Path, *flags: str) -> Replay:
    program = folder / "replay"
    command = [tool("cc", "gcc"), "-std=c11", "-O2", *STRICT, *flags, f"-I{CORE}", f"-I{folder}"]
    run(*command, NATIVE / "replay.c", *CORE_FILES, "-o", program, "-lm")
    return parse(run(program))


@pytest.fixture(scope="module")
def double(folder: Path) -> Replay:
    return on_this_machine(folder)


@pytest.fixture(scope="module")
def single(folder: Path) -> Replay:
    return on_this_machine(folder, "-DAPNC_SINGLE", "-Wdouble-promotion")


def test_the_walk_stores_its_trot(double: Replay) -> None:
    assert len(LOADS) == 3600 and double.kappa[0] == 0.0 and double.kappa[-1] == 1.0
    assert np.abs(double.phi_memory[-1] - TROT).max() < np.pi / 4


def test_single_precision_walks_as_double_does(single: Replay, double: Replay) -> None:
    """Within 1e-3 rad over a minute; couplings from the same tick on, with the same phases."""
    assert 0.0 < np.abs(single.theta - double.theta).max() < 1e-3
    np.testing.assert_array_equal(single.kappa, double.kappa)
    np.testing.assert_allclose(single.phi_memory, double.phi_memory, rtol=0, atol=1e-3)


BOARDS = {
    "M4 float": ("mps2-an386", "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -DAPNC_SINGLE"),
    "M4 double": ("mps2-an386", "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16"),
    "M7 float": ("mps2-an500", "-mcpu=cortex-m7 -mfpu=fpv5-d16 -DAPNC_SINGLE"),
    "M7 double": ("mps2-an500", "-mcpu=cortex-m7 -mfpu=fpv5-d16"),
}
MOST_INSTRUCTIONS = {"M4 float": 5_000, "M4 double": 120_000, "M7 float": 5_000, "M7 double": 5_000}
"""Per tick; what docs/on_a_robot.md says, with room for other compilers."""


def on_a_board(name: str, folder: Path) -> Replay:
    board, flags = BOARDS[name]
    compiler = tool("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    emulator = tool("qemu-system-arm", "qemu-system-arm")
    if "nosys.specs" not in run(compiler, "--print-file-name=nosys.specs"):
        pytest.skip("newlib is missing (Debian package libnewlib-arm-none-eabi)")
    program = folder / "replay.elf"
    command = [compiler, "-std=c11", "-O2", "-ffp-contract=off", "-mthumb", "-mfloat-abi=hard"]
    command += [*flags.split(), "-Wall", "-Wextra", "-Werror", f"-I{CORE}", f"-I{folder}"]
    command += ["-nostartfiles", "--specs=rdimon.specs", "-T", str(NATIVE / "cortex_m.ld")]
    run(*command, NATIVE / "replay.c", *CORE_FILES, "-o", program, "-lm")
    command = [emulator, "-M", board, "-nographic", "-monitor", "none", "-serial", "none"]
    command += ["-semihosting-config", "enable=on,target=native", "-icount", "shift=0"]
    return parse(run(*command, "-kernel", program))


@pytest.mark.parametrize("name", BOARDS)
def test_a_bare_cortex_m_walks_the_same(
    name: str, folder: Path, single: Replay, double: Replay
) -> None:
    board, here = on_a_board(name, folder), single if "float" in name else double
    # float takes the C library's functions, whose last bits differ; double takes our own
    atol = 1e-5 if "float" in name else 0.0
    np.testing.assert_allclose(board.theta, here.theta, rtol=0, atol=atol)
    np.testing.assert_array_equal(board.kappa, here.kappa)
    np.testing.assert_allclose(board.phi_memory, here.phi_memory, rtol=0, atol=10 * atol)
    # the counter counts: 4000 instructions are found as such
    assert abs(board.counted - 4000) <= 80
    assert 1_000 < board.instructions < MOST_INSTRUCTIONS[name]
    print(f"{name}: {board.instructions} instructions, {board.state + board.variables} B")


def test_memory_is_what_the_page_says(single: Replay) -> None:
    page = (FMU_SRC.parent / "docs" / "on_a_robot.md").read_text()
    assert f"{single.state} bytes of state" in page
    assert f"{single.variables} bytes of variables" in page


CMAKE = """\
cmake_minimum_required(VERSION 3.16)
project(robot C CXX)
add_subdirectory({source} apnc)
add_executable(robot main.cpp)
target_link_libraries(robot PRIVATE apnc::core)
"""
MAIN = """\
#include <cstdio>
#include "apnc.h"
static apnc_data data;
static apnc_state state;
int main() {
    apnc_defaults(&data);
    apnc_init(&data.parameters, &state, &data.outputs);
    apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
    std::printf("%d %d %d", APNC_LEGS, (int)sizeof(apnc_real), (int)data.outputs.tick);
}
"""


@pytest.mark.parametrize(
    ("options", "printed"),
    [((), "4 8 1"), (("-DAPNC_LEGS=6", "-DAPNC_SINGLE=ON"), "6 4 1")],
)
def test_cmake_builds_a_program_with_the_core(
    options: tuple[str, ...], printed: str, tmp_path: Path
) -> None:
    cmake = tool("cmake", "cmake")
    tool("g++", "g++")
    (tmp_path / "CMakeLists.txt").write_text(CMAKE.format(source=FMU_SRC))
    (tmp_path / "main.cpp").write_text(MAIN)
    run(cmake, "-S", tmp_path, "-B", tmp_path / "build", *options)
    run(cmake, "--build", tmp_path / "build")
    assert run(tmp_path / "build" / "robot") == printed


def test_the_loop_for_linux_runs_and_says_how_late_it_is(tmp_path: Path) -> None:
    source, program = FMU_SRC / "example" / "loop.c", tmp_path / "loop"
    command = [tool("cc", "gcc"), "-std=c11", "-O2", *STRICT, f"-I{CORE}", source, *CORE_FILES]
    run(*command, "-o", program, "-lm")
    printed = run(program, "60")
    print(printed)
    figures = re.fullmatch(
        r"60 ticks, late by (\d+) us on average, (\d+) us at most; a tick took \d+ us at most\n",
        printed,
    )
    assert figures and int(figures[1]) <= int(figures[2])
