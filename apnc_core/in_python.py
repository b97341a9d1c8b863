"""Converts values to Python's own types, once, where they enter the package."""

from __future__ import annotations

import os
from enum import Enum
from numbers import Integral, Real
from typing import Any, Final

_OWN: Final = frozenset((float, int, bool, str, type(None)))


def in_python(value: object) -> Any:
    """The value with numbers and arrays of numpy in Python's own types and paths as text.

    Args:
        value: anything. The entries of a list or tuple are converted too; what is no number, array
            or path is returned as it is.

    The result can be written as JSON and is equal to the value.
    """
    if type(value) in _OWN or isinstance(value, Enum):
        return value
    if hasattr(value, "tolist"):  # of numpy, which takes long to import
        value = value.tolist()
    if isinstance(value, list):
        return [in_python(entry) for entry in value]
    if isinstance(value, tuple):
        return tuple(in_python(entry) for entry in value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, bool):
        return value
    if isinstance(value, Integral):
        return int(value)
    return float(value) if isinstance(value, Real) else value
