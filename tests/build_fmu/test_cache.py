"""Where things are kept, and what happens where the home cannot be written."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from build_fmu import cache


@pytest.fixture(autouse=True)
def fresh(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.delenv(cache.VARIABLE, raising=False)
    cache._usual.cache_clear()
    yield
    cache._usual.cache_clear()


@pytest.fixture
def no_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    if sys.platform == "win32":
        pytest.skip("needs /dev/null")
    # not even root can make a folder below a device
    monkeypatch.setenv("HOME", "/dev/null/home")
    monkeypatch.setenv("XDG_CACHE_HOME", "/dev/null/cache")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_the_variable_decides(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("APNC_CACHE", str(tmp_path / "mine"))
    assert cache.cache_folder() == tmp_path / "mine"


def test_without_a_home_it_is_a_private_temporary_folder(no_home: Path) -> None:
    folder = cache.cache_folder()
    assert folder.parent == no_home and folder.stat().st_mode & 0o077 == 0
    cache._usual.cache_clear()
    assert cache.cache_folder() == folder  # the next run finds what this one kept


def test_a_folder_that_others_can_write_is_not_trusted(no_home: Path) -> None:
    planted = no_home / f"apnc-{os.getuid()}"
    planted.mkdir()
    planted.chmod(0o777)
    folder = cache.cache_folder()
    assert folder != planted and folder.stat().st_mode & 0o077 == 0


def test_a_link_is_not_followed(no_home: Path) -> None:
    (no_home / f"apnc-{os.getuid()}").symlink_to(no_home)
    assert cache.cache_folder() != no_home / f"apnc-{os.getuid()}"


def test_temporary_folders_lie_in_that_of_the_user_and_go(no_home: Path) -> None:
    with cache.temporary_folder() as name:
        folder = Path(name)
        assert folder.parent.parent == no_home and folder.parent.stat().st_mode & 0o077 == 0
        (folder / "x").write_text("x")
    assert not folder.exists() and folder.parent.is_dir()
