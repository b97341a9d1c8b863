"""MuJoCo, loaded at its first use."""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any


@cache
def mj() -> Any:
    """The module. It is untyped because its type stubs differ between versions."""
    return importlib.import_module("mujoco")
