"""The same bits from every compiler, on every platform, in every kind of plant that it has."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from c_plant import NO_CONTRACTION, SOURCES
from compilers import NATIVE, run, tool
from native_driver import runner

from build_fmu.cache import cache_folder
from build_fmu.library import library_path

SHORT, LONG = "10", "60"
"""Ticks of the walks of ``plant_hash``."""

IN_NODE = """
const { WASI } = require("node:wasi");
const program = require("node:fs").readFileSync(process.argv[2]);
const wasi = new WASI({ version: "preview1", args: process.argv.slice(2), env: {} });
WebAssembly.compile(program)
  .then((module) => WebAssembly.instantiate(module, wasi.getImportObject()))
  .then((instance) => process.exit(wasi.start(instance)));
"""

ZIG = (sys.executable, "-m", "ziglang", "cc")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("platforms")


@pytest.fixture(scope="module")
def ours(folder: Path) -> Path:
    """The driver with the library that the package uses."""
    library = library_path()
    program = folder / "ours"
    command = [tool("cc", "gcc"), "-std=c11", f"-I{SOURCES}", NATIVE / "plant_hash.c", library]
    run(*command, f"-Wl,-rpath,{library.parent}", "-o", program, "-lm")
    return program


def built(compiler: tuple[str, ...], program: Path, *flags: str) -> Path:
    """The driver together with the sources of the plant."""
    sources = [*sorted(SOURCES.glob("*.c")), NATIVE / "plant_hash.c"]
    command = [*compiler, "-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", NO_CONTRACTION]
    done = subprocess.run(
        [*command, *flags, f"-I{SOURCES}", *map(str, sources), "-o", str(program), "-lm"],
        env={"ZIG_GLOBAL_CACHE_DIR": str(cache_folder() / "zig")} | os.environ,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return program


def by_compiler(name: str, ours: Path, folder: Path, ticks: str, *flags: str) -> None:
    program = built((tool(name, name),), folder / f"{name}{'_'.join(flags)}", *flags)
    assert run(program, ticks) == run(ours, ticks)


@pytest.mark.thorough
def test_gcc_without_vectors(ours: Path, folder: Path) -> None:
    by_compiler("gcc", ours, folder, SHORT, "-O1", "-DPLANT_PLAIN")


@pytest.mark.thorough
@pytest.mark.parametrize("flags", [("-O2",), ("-O3", "-march=native")], ids=" ".join)
@pytest.mark.parametrize("name", ["gcc", "clang"])
def test_compilers_of_the_system(
    name: str, flags: tuple[str, ...], ours: Path, folder: Path
) -> None:
    if name == "gcc" and "-march=native" in flags:
        # where the processor has FMA, GCC 12 fuses products and sums of what it makes vectors of,
        # even with -ffp-contract=off; docs/physics/program.md says so to who compiles by hand
        flags = (*flags, "-fno-tree-slp-vectorize")
    by_compiler(name, ours, folder, LONG, *flags)


def on_arm(ours: Path, folder: Path, ticks: str, optimised: str) -> None:
    emulator = tool("qemu-aarch64", "qemu-user")
    compiler = (*ZIG, "-target", "aarch64-linux-musl")
    program = built(compiler, folder / f"arm{optimised}", optimised)
    assert run(emulator, program, ticks) == run(ours, ticks)


@pytest.mark.thorough
def test_arm(ours: Path, folder: Path) -> None:
    on_arm(ours, folder, SHORT, "-O1")


@pytest.mark.thorough
def test_arm_as_it_is_shipped(ours: Path, folder: Path) -> None:
    on_arm(ours, folder, LONG, "-O2")


@pytest.mark.thorough
@pytest.mark.parametrize("flags", [(), ("-msimd128",)], ids=["plain", "simd128"])
def test_webassembly(flags: tuple[str, ...], ours: Path, folder: Path) -> None:
    node = tool("node", "nodejs")
    host = folder / "host.cjs"
    host.write_text(IN_NODE, encoding="utf-8")
    compiler = (*ZIG, "-target", "wasm32-wasi")
    program = built(compiler, folder / f"hash{''.join(flags)}.wasm", "-O2", *flags)
    assert run(node, "--no-warnings", host, program, LONG) == run(ours, LONG)


@pytest.mark.thorough
def test_windows(ours: Path, folder: Path) -> None:
    program = built((*ZIG, "-target", "x86_64-windows-gnu"), folder / "hash.exe", "-O2", "-s")
    how = runner("win64", folder)
    done = subprocess.run(
        [*how.command, str(program), LONG],
        env={**os.environ, **dict(how.environment)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == run(ours, LONG).split()
