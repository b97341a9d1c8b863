"""Compilation: where the cache lies, and without a place to write."""

import importlib.util
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numba
import pytest

from exudyn_models.physics import compiled as module
from exudyn_models.physics.compiled import compiled

SOURCE = """
from exudyn_models.physics.compiled import compiled

@compiled
def halve(x):
    return x / 2.0
"""


def test_functions_compile_where_nothing_can_be_cached(monkeypatch: pytest.MonkeyPatch) -> None:
    real = numba.njit

    def read_only(*arguments: object, cache: bool = False, **options: object) -> object:
        if cache:
            return lambda function: (_ for _ in ()).throw(RuntimeError("no locator available"))
        return real(*arguments, **options)

    monkeypatch.setattr(numba, "njit", read_only)

    @compiled
    def halve(x: float) -> float:
        return x / 2.0

    assert halve(3.0) == 1.5
    assert hasattr(halve, "py_func")


@pytest.fixture
def load(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], ModuleType]:
    """Loads a compiled module anew, as another process would, with nowhere of its own to cache."""
    package = tmp_path / "package"
    package.mkdir()
    (package / "halves.py").write_text(SOURCE)
    (package / "__pycache__").touch()  # a file: even root makes no folder of this name
    monkeypatch.setenv("HOME", "/dev/null")
    for name in ("XDG_CACHE_HOME", "APNC_CACHE", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    module._temporary_folder.cache_clear()

    def load() -> ModuleType:
        spec = importlib.util.spec_from_file_location("halves", package / "halves.py")
        assert spec and spec.loader
        halves = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(halves)
        assert halves.halve(3.0) == 1.5
        return halves

    return load


def caches(folder: Path) -> list[Path]:
    return list(folder.rglob("*.nbi"))


def test_without_a_home_the_cache_is_a_temporary_folder_that_workers_share(
    load: Callable[[], ModuleType], tmp_path: Path
) -> None:
    assert sum(load().halve.stats.cache_hits.values()) == 0
    assert len(caches(tmp_path / "temporary")) == 1
    assert sum(load().halve.stats.cache_hits.values()) == 1
    folder = next((tmp_path / "temporary").iterdir())
    assert folder.stat().st_mode & 0o077 == 0


@pytest.mark.skipif(os.name == "nt", reason="folders of other users are told by their owner")
def test_a_temporary_folder_that_others_may_write_is_not_used(
    load: Callable[[], ModuleType], tmp_path: Path
) -> None:
    trap = tmp_path / "temporary" / f"apnc-{os.getuid()}"
    trap.mkdir()
    trap.chmod(0o777)
    load()
    assert not caches(trap)
    assert len(caches(tmp_path / "temporary")) == 1


def test_one_variable_says_where_the_cache_lies(
    load: Callable[[], ModuleType], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("APNC_CACHE", str(tmp_path / "chosen"))
    before = numba.config.CACHE_DIR
    load()
    assert len(caches(tmp_path / "chosen" / "numba")) == 1
    assert before == numba.config.CACHE_DIR


def test_a_variable_that_names_no_folder_does_no_harm(
    load: Callable[[], ModuleType], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("APNC_CACHE", "/dev/null/cache")
    load()
    assert len(caches(tmp_path / "temporary")) == 1
