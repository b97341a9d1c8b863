"""The files of a release: all there, as the list says, with the right checksums."""

from __future__ import annotations

import hashlib
from inspect import signature
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu

from build_fmu import release as module
from build_fmu.platforms import PLATFORMS, host_platform
from build_fmu.release import VARIANTS, release


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("release") / "of today"
    release(path, platforms=(host_platform(),))
    return path


def test_every_variant_is_there_and_says_what_it_is(folder: Path) -> None:
    found = set()
    for name, options, _ in VARIANTS:
        assert validate_fmu(str(folder / name)) == []
        description = fmpy.read_model_description(str(folder / name))
        assert description.fmiVersion == f"{options.fmi}.0"
        loads = [v for v in description.modelVariables if v.name.endswith("grf")]
        legs = int(loads[0].dimensions[0].start) if options.fmi == 3 else len(loads)
        found.add((description.fmiVersion, legs, loads[0].name))
    assert found == {
        (fmi, legs, name)
        for legs in (4, 6, 8)
        for fmi, name in (("2.0", "leg[1].grf"), ("2.0", "leg1_grf"), ("3.0", "grf"))
    }


def test_a_release_is_for_all_platforms() -> None:
    assert signature(release).parameters["platforms"].default == tuple(PLATFORMS)


def test_checksums_fit(folder: Path) -> None:
    lines = (folder / "SHA256SUMS").read_text().splitlines()
    listed = dict(reversed(line.split("  ")) for line in lines)
    assert set(listed) == {p.name for p in folder.iterdir()} - {"SHA256SUMS"}
    for name, digest in listed.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest


def test_list_names_every_file(folder: Path) -> None:
    text = (folder / "index.md").read_text()
    for name, _, what in VARIANTS:
        assert f"| `{name}` |" in text and what in text


def test_nothing_is_written_if_a_build_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "cached_fmu", lambda *_: (_ for _ in ()).throw(ValueError("no")))
    with pytest.raises(ValueError, match="no"):
        release(tmp_path / "out")
    assert not (tmp_path / "out").exists()
