"""Compilation of the inner loop: cached on disk, somewhere that can be written."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Compile a function of numbers, arrays and tuples; division by zero gives inf or nan.

    Pitfall: the cache notices changes of the function's own file only, so compiled functions that
    call each other belong in one file.
    """
    return cast(Function, cached(numba.njit, function))


def cached(compiler: Callable[..., Any], function: Callable[..., Any], *arguments: Any) -> Any:
    """Compile with a cache on disk, or without one where there is no place or no source file.

    Args:
        compiler: ``numba.njit`` or ``numba.cfunc``.
        function: what to compile.
        arguments: of the compiler.

    The place is ``APNC_CACHE`` if it is set; else numba's own, beside the source or in the user's
    cache folder; else, where neither can be written, a folder for temporary files, which all
    processes of a user share.
    """
    chosen = os.environ.get("APNC_CACHE")
    places = [lambda: Path(chosen) / "numba"] if chosen else [lambda: None]
    for place in (*places, _temporary_folder):
        with contextlib.suppress(RuntimeError), _cache_in(place()):
            return compiler(*arguments, cache=True, error_model="numpy")(function)
    return compiler(*arguments, error_model="numpy")(function)


@contextlib.contextmanager
def _cache_in(folder: Path | None) -> Iterator[None]:
    """Let numba choose the place of a cache here; it does so when a function is decorated."""
    if folder is None:
        yield
        return
    config: Any = numba.config
    before, config.CACHE_DIR = config.CACHE_DIR, str(folder)
    try:
        yield
    finally:
        config.CACHE_DIR = before


@cache
def _temporary_folder() -> Path:
    """A folder of this user's alone: code is loaded from it, so nobody else may write there."""
    user = str(os.getuid()) if hasattr(os, "getuid") else "user"
    folder = Path(tempfile.gettempdir()) / f"apnc-{user}"
    with contextlib.suppress(OSError):
        folder.mkdir(mode=0o700, exist_ok=True)
        state = folder.lstat()
        if os.name == "nt" or (state.st_uid == os.getuid() and state.st_mode & 0o777 == 0o700):
            return folder
    return Path(tempfile.mkdtemp(prefix="apnc-"))
