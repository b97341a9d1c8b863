"""MuJoCo, loaded at its first use."""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any


@cache
def mj() -> Any:
    """The module; untyped, since what its stubs say differs from version to version."""
    return importlib.import_module("mujoco")
