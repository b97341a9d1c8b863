"""MuJoCo, imported once for the whole package."""

from __future__ import annotations

from typing import Any

import mujoco

# Untyped: what its stubs say differs from version to version.
mj: Any = mujoco
