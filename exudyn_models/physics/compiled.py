"""Compilation of the inner loop: cached on disk where there is a place to write."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Compile a function of numbers, arrays and tuples; division by zero gives inf or nan.

    Numba refuses to cache when neither the package nor the user's cache folder can be written
    (a read-only installation): then it compiles anew in every process, which takes some seconds.
    Pitfall: the cache notices changes of the function's own file only, so compiled functions that
    call each other belong in one file.
    """
    try:
        return cast(Function, numba.njit(cache=True, error_model="numpy")(function))
    except RuntimeError:
        return cast(Function, numba.njit(error_model="numpy")(function))
