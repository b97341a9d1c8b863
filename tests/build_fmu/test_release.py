"""The files of a release: all there, as the list says, with the right checksums."""

from __future__ import annotations

import hashlib
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu

from build_fmu import release as module
from build_fmu.release import VARIANTS, release


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("release") / "of today"
    release(path)
    return path


def test_every_variant_is_there_and_says_what_it_is(folder: Path) -> None:
    seen = set()
    for name, options, _ in VARIANTS:
        assert validate_fmu(str(folder / name)) == []
        description = fmpy.read_model_description(str(folder / name))
        assert description.fmiVersion == f"{options.fmi}.0"
        names = {v.name for v in description.modelVariables}
        seen.add((description.fmiVersion, frozenset(names & {"grf", "leg6_grf", "leg4_grf",
                                                             "leg[4].grf", "leg[6].grf"})))  # fmt: skip
        assert set(fmpy.supported_platforms(str(folder / name))) >= {"linux64", "win64"} or (
            options.fmi == 3
        )
    assert len({name for name, _, _ in VARIANTS}) == 6 and len(seen) == 5


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
