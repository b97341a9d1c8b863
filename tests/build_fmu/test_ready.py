"""FMUs that come with the package: taken if they are true to the sources, and only then."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from build_fmu import build, compile, sources
from build_fmu.build import build_key, cached_fmu, host_fmu
from build_fmu.options import BuildOptions
from build_fmu.package import zip_fmu
from build_fmu.platforms import PLATFORMS, BuildError, host_platform, placed

ROOT = Path(__file__).resolve().parents[2]
HOST = BuildOptions(platforms=(host_platform(),))


@pytest.fixture
def ready(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a ready FMU, no compiler, an empty cache."""
    (tmp_path / f"{build_key(HOST)}.fmu").write_bytes(b"ready")
    monkeypatch.setattr(build, "READY", tmp_path)
    monkeypatch.setattr(build, "compiler_version", str)
    monkeypatch.setenv("APNC_CACHE", str(tmp_path / "cache"))
    return tmp_path


def test_it_is_taken_without_a_compiler_and_without_a_cache(ready: Path) -> None:
    assert host_fmu().read_bytes() == cached_fmu(HOST).read_bytes() == b"ready"
    assert not (ready / "cache").exists()


@pytest.fixture
def everywhere(ready: Path) -> bytes:
    """A ready FMU for all platforms, with made-up binaries."""
    libraries = {name: f"library for {name}".encode() for name in PLATFORMS}
    content = zip_fmu({"modelDescription.xml": b"<xml/>"} | placed(libraries, 2))
    (ready / f"{build_key(BuildOptions())}.fmu").write_bytes(content)
    return content


def test_one_for_all_platforms_serves_this_machine(everywhere: bytes) -> None:
    assert host_fmu().read_bytes() == everywhere
    assert cached_fmu(BuildOptions()).read_bytes() == everywhere


def test_fewer_platforms_are_taken_from_it(everywhere: bytes) -> None:
    path = cached_fmu(BuildOptions(platforms=("win64", "aarch64-darwin")))
    with zipfile.ZipFile(path) as archive:
        assert {n: archive.read(n) for n in archive.namelist()} == {
            "modelDescription.xml": b"<xml/>",
            "binaries/win64/Apnc.dll": b"library for win64",
            "binaries/aarch64-darwin/Apnc.dylib": b"library for aarch64-darwin",
            "binaries/darwin64/Apnc.dylib": b"library for aarch64-darwin",
        }


def test_intel_macs_alone_do_not_get_the_file_for_both_processors(
    everywhere: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "compiler_version", lambda: "1")
    monkeypatch.setattr(build, "fmu_bytes", lambda options, progress: b"built anew")
    assert cached_fmu(BuildOptions(platforms=("darwin64",))).read_bytes() == b"built anew"
    assert cached_fmu(BuildOptions(platforms=("linux64",))).read_bytes() != b"built anew"


def test_on_arm_linux_the_folder_that_fmpy_opens_is_for_arm(
    everywhere: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "host_platform", lambda: "aarch64-linux")
    with zipfile.ZipFile(host_fmu()) as archive:
        assert archive.read("binaries/linux64/Apnc.so") == b"library for aarch64-linux"


def test_after_a_change_of_the_sources_the_compiler_is_asked_for(
    ready: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = sources.own_files()
    changed = files | {"controller.c": files["controller.c"] + b"/* changed */"}
    monkeypatch.setattr(sources, "own_files", lambda fmi: changed)
    with pytest.raises(BuildError, match="pip install ziglang") as raised:
        host_fmu()
    assert "\n" not in str(raised.value)


def test_what_is_not_ready_asks_for_the_compiler(ready: Path) -> None:
    with pytest.raises(BuildError, match="none of the 1 that came with the package"):
        host_fmu(5)
    assert cached_fmu(BuildOptions(platforms=())).is_file()  # sources only: nothing to compile


def test_compiling_without_a_compiler_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile, "compiler_version", str)
    with pytest.raises(BuildError, match="the C compiler is not installed: pip install ziglang"):
        build.fmu_bytes(HOST)


@pytest.mark.parametrize("change", ["legs", "naming", "settings"])
def test_the_key_changes_with_the_options(change: str) -> None:
    other = {"legs": 6, "naming": "flat", "settings": {"xi": 0.03}}[change]
    assert build_key(BuildOptions(**{change: other})) != build_key(BuildOptions())  # type: ignore[arg-type]


def test_a_wheel_for_this_machine_carries_its_fmus_and_the_robot_in_c(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wheel_of = pytest.importorskip("hatchling.builders.wheel").WheelBuilder
    monkeypatch.delenv("APNC_WHEEL_PLATFORMS", raising=False)
    (wheel,) = wheel_of(str(ROOT)).build(directory=str(tmp_path), versions=["standard"])
    name = Path(wheel).name
    assert name.endswith(".whl") and "-py3-none-" in name and "any" not in name
    unpacked = tmp_path / "unpacked"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(unpacked)
    assert not [name for name in ("research", "benchmarks", "tests") if (unpacked / name).exists()]
    assert len(list((unpacked / "build_fmu" / "ready").glob("*.fmu"))) == 3
    # the key of what was packed is the key that the packed code asks for
    code = (
        "from build_fmu.build import host_fmu\n"
        "from build_fmu.library import library_path\n"
        "print(library_path(), host_fmu(4), host_fmu(6), host_fmu(8), sep='\\n')"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(unpacked)},
        capture_output=True,
        text=True,
        check=True,
    )
    library, *fmus = done.stdout.splitlines()
    assert Path(library).is_relative_to(unpacked)
    for line, legs in zip(fmus, (4, 6, 8), strict=True):
        assert Path(line).is_relative_to(unpacked)
        with zipfile.ZipFile(line) as archive:
            assert f"leg[{legs}].grf".encode() in archive.read("modelDescription.xml")
            assert f"leg[{legs + 1}].grf".encode() not in archive.read("modelDescription.xml")


def test_the_tag_says_where_the_binaries_run() -> None:
    pytest.importorskip("hatchling")
    spec = importlib.util.spec_from_file_location("hatch_build", ROOT / "hatch_build.py")
    assert spec and spec.loader
    hook = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(hook)
    assert set(hook.WHEEL_TAGS) == set(PLATFORMS)
    assert hook.wheel_tag(tuple(PLATFORMS)) == hook.wheel_tag(()) == "py3-none-any"
    assert hook.wheel_tag(("win64",)) == "py3-none-win_amd64"
    two = hook.wheel_tag(("linux64", "aarch64-linux"))
    assert two == "py3-none-linux_x86_64.linux_aarch64"
