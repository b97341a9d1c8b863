"""The controller FMU as the loop drives it."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import pytest

from apnc.loop.controller_library import controller_library
from apnc.loop.fmu_controller import FmuController, FmuError
from build_fmu.platforms import host_platform


def spoilt(fmu: Path, folder: Path, *, without: bool) -> Path:
    """A copy of an FMU whose library for this machine is missing, or is no library."""
    path = folder / "spoilt.fmu"
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            library = name.startswith(f"binaries/{host_platform()}/")
            if not (library and without):
                new.writestr(name, b"no library" if library else old.read(name))
    return path


def damaged(fmu: Path, folder: Path) -> Path:
    """A copy of an FMU of which a library's bytes are not those that were packed."""
    path = folder / "damaged.fmu"
    content = bytearray(fmu.read_bytes())
    with zipfile.ZipFile(fmu) as archive:
        member = next(i for i in archive.infolist() if i.filename.startswith("binaries/"))
    at = member.header_offset + 200
    content[at : at + 8] = b"\0" * 8
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("use", [FmuController, controller_library])
def test_a_damaged_file_is_one_line(use: Any, fmu4: Path, tmp_path: Path) -> None:
    with pytest.raises(FmuError, match=r"damaged\.fmu: damaged: ") as caught:
        use(damaged(fmu4, tmp_path))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("without", "words"),
    [(True, "no binary for"), (False, "binary for this machine does not load")],
)
def test_a_library_that_does_not_load_is_one_line_and_moves_nobody(
    without: bool, words: str, fmu4: Path, tmp_path: Path
) -> None:
    here = Path.cwd()
    with pytest.raises(FmuError, match=words) as caught:
        FmuController(spoilt(fmu4, tmp_path, without=without))
    assert "\n" not in str(caught.value) and str(caught.value).startswith(str(tmp_path))
    assert Path.cwd() == here
