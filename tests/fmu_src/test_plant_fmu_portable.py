"""The plant FMU's binaries of all platforms, and its sources as a part of other programs."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
from binaries import (
    exports,
    lief,
    needed_of_glibc,
    oldest_mac,
    part_of_windows,
    slice_of,
    standard_functions,
)
from compilers import run, tool
from native_driver import drive_plant

from apnc.system.plant_fmu import PlantBuild, plant_fmu
from apnc_plant.variables import Condition
from build_fmu.platforms import PLATFORMS, host_platform

MODEL = "LilibotPlant"
HOST = host_platform()
EACH = [p if p == HOST else pytest.param(p, marks=pytest.mark.thorough) for p in PLATFORMS]


def unzipped(build: PlantBuild, folder: Path) -> Path:
    with zipfile.ZipFile(plant_fmu(build)) as archive:
        archive.extractall(folder)
    return folder


@pytest.fixture(scope="session")
def everywhere(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU with the binaries of all platforms."""
    return unzipped(PlantBuild(), tmp_path_factory.mktemp("plant"))


@pytest.fixture
def built(platform: str, request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """The FMU with at least the binary of a platform."""
    if platform == HOST:
        return unzipped(PlantBuild(platforms=(HOST,)), tmp_path)
    everywhere: Path = request.getfixturevalue("everywhere")
    return everywhere


def library_path(folder: Path, platform: str, fmi: int = 2) -> Path:
    place = PLATFORMS[platform].folder_for(fmi)
    return folder / "binaries" / place / (MODEL + PLATFORMS[platform].suffix)


@pytest.mark.parametrize("platform", EACH)
def test_exports_are_exactly_the_functions_of_the_standard(built: Path, platform: str) -> None:
    library = slice_of(library_path(built, platform), platform)
    assert exports(library) == standard_functions()


def test_exports_of_fmi_3_are_exactly_the_functions_of_the_standard(tmp_path: Path) -> None:
    folder = unzipped(PlantBuild(fmi=3, platforms=(HOST,)), tmp_path)
    assert exports(slice_of(library_path(folder, HOST, 3), HOST)) == standard_functions(3)


@pytest.mark.parametrize("platform", EACH)
def test_it_needs_nothing_that_old_systems_do_not_have(built: Path, platform: str) -> None:
    library = slice_of(library_path(built, platform), platform)
    if platform == "win64":
        assert part_of_windows(library)
    elif "darwin" in platform:
        assert oldest_mac(library) == ([11, 0, 0] if "aarch64" in platform else [10, 15, 0])
        names = {entry.name for entry in library.libraries}
        assert names == {f"@rpath/{MODEL}.dylib", "/usr/lib/libSystem.B.dylib"}
    else:
        library = lief.parse(str(library_path(built, platform)))
        assert {"libc.so.6"} <= set(library.libraries) <= {"libc.so.6", "libm.so.6"}
        assert needed_of_glibc(library) <= (2, 17)


@pytest.fixture(scope="session")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("native")


@pytest.mark.thorough
@pytest.mark.parametrize("platform", ["aarch64-linux", "win64"])
@pytest.mark.parametrize("condition", [Condition.C2, Condition.C4, Condition.S1])
def test_other_platforms_give_the_bits_of_linux64(
    everywhere: Path, scratch: Path, platform: str, condition: Condition
) -> None:
    settings = {"seed": 7, "condition": condition.value}
    here = drive_plant("linux64", everywhere, scratch, 300, settings)
    there = drive_plant(platform, everywhere, scratch, 300, settings)
    np.testing.assert_array_equal(there, here)
    assert len(np.unique(here, axis=0)) == len(here)  # it moved to the end


BUILDS = {
    "lilibot": PlantBuild(platforms=()),
    "flat": PlantBuild(naming="flat", platforms=()),
    "hexapod": PlantBuild("hexapod", fmi=3, platforms=()),
}


@pytest.mark.thorough
def test_no_name_is_shared_between_builds_and_every_name_is_prefixed(tmp_path: Path) -> None:
    compiler, seen, objects = tool("gcc", "gcc"), set(), []
    for name, build in BUILDS.items():
        sources = unzipped(build, tmp_path / name) / "sources"
        flags = [f"-DFMI{build.fmi}_FUNCTION_PREFIX={name}_", "-std=c11", "-O0", "-Wno-psabi"]
        made = []
        for source in sorted(sources.glob("*.c")):
            made.append(source.with_suffix(".o"))
            run(compiler, *flags, "-fPIC", f"-I{sources}", "-c", source, "-o", made[-1])
        text = run(tool("nm", "binutils"), "-g", "--defined-only", *made)
        names = set(re.findall(r"^\w+ [A-Z] (\w+)$", text, re.MULTILINE))
        assert all(re.match(rf"apnc_[0-9a-f]{{8}}_|{name}_fmi", each) for each in names), names
        assert not names & seen
        seen |= names
        objects += made
    # one program takes them all
    run(compiler, "-shared", "-Wl,-z,defs", *objects, "-o", tmp_path / "all.so", "-lm")


@pytest.mark.thorough
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_a_bare_compiler_rebuilds_the_library(compiler: str, tmp_path: Path) -> None:
    sources = unzipped(BUILDS["lilibot"], tmp_path) / "sources"
    command = [tool(compiler, compiler), "-std=c11", "-Wall", "-Wextra", "-Wno-psabi", "-Werror"]
    files = sorted(sources.glob("*.c"))
    run(*command, "-shared", "-fPIC", "-O1", *files, "-o", tmp_path / "x.so", "-lm")
    assert standard_functions() <= exports(lief.parse(str(tmp_path / "x.so")))
