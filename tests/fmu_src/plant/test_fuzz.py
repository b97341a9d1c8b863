"""Random robots, commands and ticks, senseless ones included, under AddressSanitizer and UBSan."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from c_plant import NO_CONTRACTION, SOURCES
from compilers import NATIVE, SANITIZERS, tool

SHORT, LONG = 20_000, 250_000
"""Ticks per seed."""

MORE = ("-fsanitize=float-cast-overflow", NO_CONTRACTION, "-w", "-Wno-psabi")


def built(program: Path, *flags: str) -> Path:
    """The driver and the plant under the sanitizers."""
    sources = [*sorted(SOURCES.glob("*.c")), NATIVE / "plant_fuzz.c"]
    command = [tool("cc", "gcc"), "-std=c11", *SANITIZERS, *MORE, *flags, f"-I{SOURCES}"]
    done = subprocess.run(
        [*command, *map(str, sources), "-o", str(program), "-lm"],
        capture_output=True,
        text=True,
        check=False,
    )
    if "cannot find" in done.stderr and "asan" in done.stderr:
        pytest.skip("the sanitizers' run time is missing (Debian package libasan8 or libclang-rt)")
    assert done.returncode == 0, done.stderr
    return program


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Without vectors, which take half a minute to compile."""
    return built(tmp_path_factory.mktemp("fuzz") / "plain", "-DPLANT_PLAIN")


@pytest.fixture(scope="module")
def every_kind(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return built(tmp_path_factory.mktemp("fuzz") / "every_kind")


def check(program: Path, seed: int, ticks: int) -> None:
    done = subprocess.run(
        [str(program), str(seed), str(ticks)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"seed {seed}: {done.stdout}{done.stderr}"
    counted = {what: int(n) for n, what in re.findall(r"(\d+) (\w+)", done.stdout)}
    assert counted["ticks"] >= ticks
    # robots walked, fell and broke down; what was stored came back, what was damaged often did not
    assert counted["walked"] > 0.3 * ticks
    assert min(counted["fell"], counted["diverged"], counted["tunes"]) > 0.002 * ticks
    assert counted["restored"] > 0.01 * ticks
    assert min(counted["damaged"], counted["refused"]) > 0.001 * ticks


@pytest.mark.thorough
def test_ticks_by_chance(plain: Path) -> None:
    check(plain, 1, SHORT)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(101, 105))
def test_a_million_ticks_by_chance_in_every_kind(every_kind: Path, seed: int) -> None:
    check(every_kind, seed, LONG)
