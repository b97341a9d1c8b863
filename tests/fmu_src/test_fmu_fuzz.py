"""Random calls of the whole interface under AddressSanitizer, LeakSanitizer and UBSan."""

from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from compilers import NATIVE, SANITIZERS

from apnc.system.plant_fmu import PlantBuild, plant_fmu
from build_fmu.build import cached_fmu, host_fmu
from build_fmu.options import BuildOptions

BRIEF, SHORT, LONG = 50_000, 250_000, 10_000_000
"""Calls per seed."""

PLANT_SHARE = 10
"""Calls of the controller per call of the robot, whose ticks take so much longer."""

BUILDS = {
    "fmi2": (2, lambda: host_fmu(4)),
    "fmi3": (3, lambda: host_fmu(4, fmi=3)),
    "plant": (2, lambda: plant_fmu(PlantBuild(platforms=()))),
    "reals": (2, lambda: cached_fmu(BuildOptions(platforms=(), reals=True))),
    "fmi3_flat": (3, lambda: cached_fmu(BuildOptions(platforms=(), fmi=3, naming="flat"))),
}
FORMS = [
    *("fmi2", "fmi3"),
    *(pytest.param(name, marks=pytest.mark.thorough) for name in ("plant", "reals", "fmi3_flat")),
]


@pytest.fixture(scope="session", params=FORMS)
def fuzz(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The fuzz driver together with the sources as they are shipped, under the sanitizers."""
    compiler = shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        pytest.skip("gcc and clang are missing (Debian package gcc)")
    fmi, fmu = BUILDS[request.param]
    folder = tmp_path_factory.mktemp("fuzz")
    program, sources = folder / request.param, folder / "sources"
    with zipfile.ZipFile(fmu()) as archive:
        archive.extractall(folder)
    driver = NATIVE / ("fuzz.c" if fmi == 2 else "fuzz3.c")
    command = [compiler, "-std=c11", "-fno-omit-frame-pointer", *SANITIZERS, f"-I{sources}"]
    # one robot, one leg after the other: wide instructions take minutes to compile like this
    command += ["-DFUZZ_PLANT", "-DPLANT_PLAIN"] if request.param == "plant" else []
    command += [*map(str, sorted(sources.glob("*.c"))), str(driver)]
    done = subprocess.run(
        [*command, "-o", str(program), "-lm"], capture_output=True, text=True, check=False
    )
    if "cannot find" in done.stderr and "asan" in done.stderr:
        pytest.skip("the sanitizers' run time is missing (Debian package libasan8 or libclang-rt)")
    assert done.returncode == 0, done.stderr
    return program


def run(program: Path, seed: int, calls: int) -> dict[str, int]:
    """What the driver counted; a fault of any sanitizer fails the test with its report."""
    done = subprocess.run(
        [str(program), str(seed), str(calls)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"seed {seed}: {done.stdout}{done.stderr}"
    return {what: int(n) for n, what in re.findall(r"(\d+) (\w+)", done.stdout)}


def check(program: Path, seed: int, calls: int) -> None:
    plant = program.name == "plant"
    calls //= PLANT_SHARE if plant else 1
    counted = run(program, seed, calls)
    assert counted["calls"] >= calls
    # the calls got somewhere: much was accepted, much refused, and there was a lot of walking
    assert counted["ok"] > 0.3 * calls and counted["error"] > 0.3 * calls
    assert counted["ticks"] > (0.2 if plant else 1.0) * calls
    assert counted["warning"] > 0 or plant
    assert counted["discard"] > 0 or program.name.startswith("fmi3")


def test_some_random_calls(fuzz: Path) -> None:
    check(fuzz, 1, BRIEF)


@pytest.mark.thorough
@pytest.mark.parametrize("seed", range(2, 6))
def test_a_million_random_calls(fuzz: Path, seed: int) -> None:
    check(fuzz, seed, SHORT)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(101, 111))
def test_a_hundred_million_random_calls(fuzz: Path, seed: int) -> None:
    check(fuzz, seed, LONG)
