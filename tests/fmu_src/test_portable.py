"""The binaries of all platforms: what they export and need, and that they really run."""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
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
from fmu_slave import TS, slave
from native_driver import OUTPUTS, drive, drive3, load

from apnc_core.enumerations import KappaRule, Method
from build_fmu.build import cached_fmu, fmu_bytes, host_fmu
from build_fmu.options import MODEL, PLATFORMS, BuildOptions, host_platform

LINUX = ["linux64", "aarch64-linux"]
OTHERS = [pytest.param(p, marks=pytest.mark.thorough) for p in ("aarch64-linux", "win64")]
MINUTE = 3600
ALWAYS_COUPLED = {"kappa_rule": KappaRule.printed.value}


@pytest.fixture(scope="session")
def everywhere() -> Path:
    return cached_fmu(BuildOptions())


@pytest.fixture(scope="session")
def unpacked(everywhere: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("everywhere")
    with zipfile.ZipFile(everywhere) as archive:
        archive.extractall(folder)
    return folder


@pytest.fixture(scope="session")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("native")


def library_path(unpacked: Path, platform: str) -> Path:
    return unpacked / "binaries" / platform / (MODEL + PLATFORMS[platform].suffix)


def test_the_standard_has_34_functions_for_co_simulation_and_75_in_version_3() -> None:
    assert len(standard_functions()) == 34
    assert len(standard_functions(3)) == 75


@pytest.mark.parametrize("platform", PLATFORMS)
def test_exports_are_exactly_the_functions_of_the_standard(unpacked: Path, platform: str) -> None:
    library = slice_of(library_path(unpacked, platform), platform)
    assert exports(library) == standard_functions()


@pytest.fixture(scope="session")
def everywhere3(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("everywhere3")
    with zipfile.ZipFile(cached_fmu(BuildOptions(fmi=3))) as archive:
        archive.extractall(folder)
    return folder


@pytest.mark.parametrize("platform", PLATFORMS)
def test_exports_of_fmi_3_are_exactly_the_functions_of_the_standard(
    everywhere3: Path, platform: str
) -> None:
    folder = everywhere3 / "binaries" / PLATFORMS[platform].folder_for(3)
    library = slice_of(folder / (MODEL + PLATFORMS[platform].suffix), platform)
    assert exports(library) == standard_functions(3)


@pytest.mark.parametrize("platform", LINUX)
def test_linux_needs_nothing_newer_than_glibc_2_17(unpacked: Path, platform: str) -> None:
    library = lief.parse(str(library_path(unpacked, platform)))
    # floor comes from libm where the processor has no instruction for it
    assert {"libc.so.6"} <= set(library.libraries) <= {"libc.so.6", "libm.so.6"}
    assert needed_of_glibc(library) <= (2, 17)


@pytest.mark.parametrize("platform", LINUX)
def test_linux_leaves_no_symbol_without_a_library(unpacked: Path, platform: str) -> None:
    library = lief.parse(str(library_path(unpacked, platform)))
    for symbol in library.imported_symbols:
        version = symbol.symbol_version
        assert version and version.has_auxiliary_version, symbol.name


def test_windows_needs_only_what_windows_10_has(unpacked: Path) -> None:
    library = lief.parse(str(library_path(unpacked, "win64")))
    assert part_of_windows(library)
    system = library.optional_header
    assert (system.major_subsystem_version, system.minor_subsystem_version) <= (10, 0)


@pytest.mark.parametrize(
    ("platform", "oldest"), [("darwin64", [10, 15, 0]), ("aarch64-darwin", [11, 0, 0])]
)
def test_mac_needs_only_the_system_library(
    unpacked: Path, platform: str, oldest: list[int]
) -> None:
    library = slice_of(library_path(unpacked, platform), platform)
    own = [c.name for c in library.commands if c.command == lief.MachO.LoadCommand.TYPE.ID_DYLIB]
    assert own == [f"@rpath/{MODEL}.dylib"]
    needed = {entry.name for entry in library.libraries} - set(own)
    assert needed == {"/usr/lib/libSystem.B.dylib"}
    assert oldest_mac(library) == oldest
    # Apple silicon refuses unsigned code
    assert library.has_code_signature or platform == "darwin64"


def test_darwin64_is_for_both_processors(unpacked: Path) -> None:
    path = library_path(unpacked, "darwin64")
    parts = lief.MachO.parse(str(path))
    kind = lief.MachO.Header.CPU_TYPE
    assert [part.header.cpu_type for part in parts] == [kind.X86_64, kind.ARM64]
    # Apple silicon refuses code whose signature does not fit: the part is the signed file itself
    content, arm = path.read_bytes(), library_path(unpacked, "aarch64-darwin").read_bytes()
    offset = parts[1].fat_offset
    assert offset % 2**14 == 0 and content[offset : offset + len(arm)] == arm
    if file := shutil.which("file"):
        said = subprocess.run([file, "-b", path], capture_output=True, text=True, check=True)
        assert "universal binary with 2 architectures" in said.stdout


@pytest.mark.parametrize("platform", PLATFORMS)
def test_no_folder_of_the_build_is_left_inside(unpacked: Path, platform: str) -> None:
    content = library_path(unpacked, platform).read_bytes()
    home = str(Path.home()).encode()
    python = str(Path(sys.prefix)).encode()
    assert [part for part in (b"/tmp/", b"\\tmp\\", home, python) if part in content] == []


def test_archive_is_small_and_holds_nothing_else(everywhere: Path) -> None:
    assert everywhere.stat().st_size <= 1_000_000
    with zipfile.ZipFile(everywhere) as archive:
        names = archive.namelist()
    binaries = {n for n in names if n.startswith("binaries/")}
    assert binaries == {f"binaries/{p}/{MODEL}{PLATFORMS[p].suffix}" for p in PLATFORMS}
    folders = {name.split("/")[0] for name in names}
    assert folders <= {
        "modelDescription.xml", "binaries", "sources", "documentation", "model.png", "extra",
    }  # fmt: skip


@pytest.mark.thorough
def test_same_bytes_from_another_folder_with_other_caches(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = BuildOptions(platforms=("linux64", "win64", "aarch64-darwin"))
    first = fmu_bytes(options)
    elsewhere = tmp_path / "a folder with spaces and a longer name"
    elsewhere.mkdir()
    monkeypatch.setenv("TMPDIR", str(elsewhere))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.setenv("ZIG_LOCAL_CACHE_DIR", str(tmp_path / "zig"))
    assert fmu_bytes(options) == first


def moved(outputs: np.ndarray) -> set[str]:
    return {s.variable.name for s, c in zip(OUTPUTS, outputs.T, strict=True) if np.ptp(c) > 0}


@pytest.mark.thorough
@pytest.mark.parametrize("platform", ["aarch64-linux", "win64"])
@pytest.mark.parametrize("method", Method)
def test_other_platforms_give_the_bits_of_linux64(
    unpacked: Path, scratch: Path, platform: str, method: Method
) -> None:
    settings = {"method": method.value}
    here = drive("linux64", unpacked, scratch, MINUTE, settings)
    np.testing.assert_array_equal(drive(platform, unpacked, scratch, MINUTE, settings), here)
    assert {"theta_hip", "theta_knee", "phi", "d"} <= moved(here.view(float))


@pytest.mark.thorough
@pytest.mark.parametrize("platform", ["aarch64-linux", "win64"])
@pytest.mark.parametrize("MI", [0.08, 0.15, 0.24])
def test_other_platforms_give_the_bits_of_linux64_with_couplings_on(
    unpacked: Path, scratch: Path, platform: str, MI: float
) -> None:
    """At MI 0.15 a difference in the last bit would double every five seconds."""
    here = drive("linux64", unpacked, scratch, MINUTE, ALWAYS_COUPLED, MI)
    there = drive(platform, unpacked, scratch, MINUTE, ALWAYS_COUPLED, MI)
    np.testing.assert_array_equal(there, here)
    assert {"theta_hip", "g1", "g2"} <= moved(here.view(float))


@pytest.mark.parametrize("platform", ["linux64", *OTHERS])
def test_fmi_3_gives_the_bits_of_fmi_2(
    unpacked: Path, everywhere3: Path, scratch: Path, platform: str
) -> None:
    fmi2 = drive(platform, unpacked, scratch, MINUTE, ALWAYS_COUPLED)
    fmi3 = drive3(platform, everywhere3, scratch, MINUTE, ALWAYS_COUPLED)
    np.testing.assert_array_equal(fmi3, fmi2)
    assert {"theta_hip", "theta_knee", "g1"} <= moved(fmi3.view(float))


def test_driver_and_fmpy_read_the_same_bits(
    everywhere: Path, unpacked: Path, scratch: Path
) -> None:
    driven = drive(host_platform(), unpacked, scratch, 500, {"method": 1}).view(float)
    seed, loads = 1, [0.0] * 4
    with slave(everywhere) as fmu:
        fmu.start()
        for tick, expected in enumerate(driven):
            for foot in range(4):
                seed, loads[foot] = load(seed, tick, foot)
            fmu.loads(loads)
            fmu.step(tick * TS)
            assert fmu.getReal([s.value_reference for s in OUTPUTS]) == expected.tolist()


@pytest.mark.parametrize("compiler", ["cc", "clang"])
def test_a_bare_compiler_rebuilds_the_library(
    unpacked: Path, tmp_path: Path, compiler: str
) -> None:
    if shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is missing")
    sources = sorted(str(path) for path in (unpacked / "sources").glob("*.c"))
    library = tmp_path / "Apnc.so"
    command = [compiler, "-shared", "-fPIC", "-O2", *sources, "-o", str(library), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert standard_functions() <= exports(lief.parse(str(library)))


def test_fmpy_rebuilds_it_from_its_sources(tmp_path: Path) -> None:
    for tool in ("cmake", "cc"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is missing (Debian packages cmake and gcc)")
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu_bytes(BuildOptions(platforms=())))
    command = [sys.executable, "-m", "fmpy", "compile", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    built = fmpy.simulate_fmu(str(path), stop_time=2.0)
    shipped = fmpy.simulate_fmu(str(host_fmu()), stop_time=2.0)
    assert built.dtype == shipped.dtype and len(built) == len(shipped) == 121
    for name in built.dtype.names:
        np.testing.assert_array_equal(built[name], shipped[name])


def test_the_command_builds_all_platforms_unless_told_otherwise(
    everywhere: Path, tmp_path: Path
) -> None:
    path = tmp_path / "a folder (1)" / "größe" / "Apnc.fmu"
    command = [sys.executable, "-m", "apnc", "build", "--output", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert path.read_bytes() == everywhere.read_bytes()
    # and such a path is no obstacle to loading it
    assert fmpy.simulate_fmu(str(path), stop_time=0.5)["tick"][-1] == 30
