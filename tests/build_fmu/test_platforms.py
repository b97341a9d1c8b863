"""Which binary of an FMU this machine takes, and what is said where none can be loaded."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from fmpy.fmi2 import FMU2Slave

from build_fmu.build import host_fmu
from build_fmu.platforms import (
    MODEL,
    PLATFORMS,
    BuildError,
    host_platform,
    library_of,
    placed,
    universal,
    why_not_loaded,
)

MACHINES = {
    ("linux", "x86_64"): ("linux64", "x86_64-linux"),
    ("linux", "aarch64"): ("aarch64-linux", "aarch64-linux"),
    ("darwin", "x86_64"): ("darwin64", "x86_64-darwin"),
    ("darwin", "arm64"): ("aarch64-darwin", "aarch64-darwin"),
    ("win32", "AMD64"): ("win64", "x86_64-windows"),
}


def pretend(monkeypatch: pytest.MonkeyPatch, system: str, machine: str) -> None:
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)


def unpacked(folder: Path, paths: dict[str, bytes]) -> Path:
    for name, content in paths.items():
        path = folder / name
        path.parent.mkdir(parents=True)
        path.write_bytes(content)
    return folder


def thin(processor: int, length: int) -> bytes:
    return b"\xcf\xfa\xed\xfe" + processor.to_bytes(4, "little") + bytes(length)


X86, ARM = thin(0x01000007, 20_000), thin(0x0100000C, 100)
ALL = {"linux64": b"a", "aarch64-linux": b"b", "win64": b"c", "darwin64": X86,
       "aarch64-darwin": ARM}  # fmt: skip


@pytest.mark.parametrize("machine", MACHINES)
def test_the_library_that_fits(
    machine: tuple[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, *machine)
    for fmi, name in zip((2, 3), MACHINES[machine], strict=True):
        folder = unpacked(tmp_path / str(fmi), placed(ALL, fmi))
        assert library_of(folder, fmi).parent.name == name


@pytest.mark.parametrize(
    ("machine", "opened"), [(("linux", "aarch64"), "linux64"), (("darwin", "arm64"), "darwin64")]
)
def test_a_build_for_arm_alone_fills_the_folder_that_importers_open(
    machine: tuple[str, str], opened: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, *machine)
    host = host_platform()
    found = placed({host: b"arm"}, 2)
    assert {path.split("/")[1] for path in found} == {host, opened}
    assert set(found.values()) == {b"arm"}
    assert {path.split("/")[1] for path in placed({host: b"arm"}, 3)} == {host}


def test_arm_linux_does_not_hide_the_intel_library() -> None:
    found = placed({"aarch64-linux": b"arm", "linux64": b"intel"}, 2)
    assert found[f"binaries/linux64/{MODEL}.so"] == b"intel"


def test_another_tools_arm_library_in_the_folder_for_intel_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, "linux", "aarch64")
    folder = unpacked(tmp_path, {f"binaries/linux64/{MODEL}.so": b"arm"})
    assert library_of(folder).parent.name == "linux64"


def test_no_library_for_this_machine_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend(monkeypatch, "linux", "x86_64")
    folder = unpacked(tmp_path, placed({"win64": b"c", "aarch64-darwin": ARM}, 3))
    with pytest.raises(BuildError, match=r"^no binary for x86_64-linux: the FMU has aarch64-darw"):
        library_of(folder, 3)


def test_universal_file_says_where_each_part_lies() -> None:
    content = universal((X86, ARM))
    words = [int.from_bytes(content[i : i + 4], "big") for i in range(0, 48, 4)]
    assert words[:2] == [0xCAFEBABE, 2]
    for part, (kind, _, offset, size, align) in zip((X86, ARM), (words[2:7], words[7:12]),
                                                    strict=True):  # fmt: skip
        assert kind == int.from_bytes(part[4:8], "little")
        assert align == 14 and offset % 2**14 == 0
        assert content[offset : offset + size] == part


@pytest.fixture
def noexec(tmp_path: Path) -> Iterator[Path]:
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("only root can mount a folder that forbids execution")
    if shutil.which("mount") is None:
        pytest.skip("the program mount is missing")
    mount = ["mount", "-t", "tmpfs", "-o", "noexec,size=8m", "tmpfs", str(tmp_path)]
    done = subprocess.run(mount, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        pytest.skip(f"no folder that forbids execution can be mounted: {done.stderr.strip()}")
    yield tmp_path
    subprocess.run(["umount", "-l", str(tmp_path)], check=True)


def test_a_folder_that_forbids_execution_is_named(
    noexec: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with zipfile.ZipFile(host_fmu()) as archive:
        archive.extractall(noexec)
    monkeypatch.chdir(Path.cwd())  # FMPy goes elsewhere to load, and stays if it fails
    with pytest.raises(Exception, match="Failed to load shared library") as refused:
        FMU2Slave(
            guid="",
            unzipDirectory=str(noexec),
            modelIdentifier=MODEL,
            instanceName="test",
            libraryPath=str(library_of(noexec)),
        )
    line = why_not_loaded(refused.value, noexec)
    assert line.startswith(f"{noexec} forbids execution") and "set TMPDIR" in line


def test_any_other_refusal_is_quoted(tmp_path: Path) -> None:
    assert why_not_loaded(OSError("wrong ELF class"), tmp_path).endswith("wrong ELF class")


def test_platforms_have_one_folder_each() -> None:
    for fmi in (2, 3):
        assert len({p.folder_for(fmi) for p in PLATFORMS.values()}) == len(PLATFORMS)
