"""The controller FMU as the loop drives it."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

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
