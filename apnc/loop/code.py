"""Which code runs: a hash of the files that a motion and what is measured of it depend on."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path
from typing import Final

_PACKAGES: Final = (
    "apnc",
    "apnc_core",
    "apnc_plant",
    "build_fmu",
    "exudyn_models",
    "fmu_src",
    "mujoco_models",
)
_SUFFIXES: Final = (".c", ".h", ".py", ".toml")

# of apnc: what only shows, times, exports or looks for parameters
_APART: Final = {"bench", "cli", "report", "search", "system", "figures.py"}


ROOT: Final = Path(__file__).parents[2]


@cache
def code_hash(root: Path = ROOT) -> str:
    """Hash of names and content of the packages' files below ``root``, 12 hex digits."""
    found = hashlib.sha256()
    paths = [path for package in _PACKAGES for path in (root / package).rglob("*.*")]
    for path in sorted(path for path in paths if path.suffix in _SUFFIXES):
        name = path.relative_to(root)
        if not (name.parts[0] == "apnc" and _APART & {*name.parts}):
            content = hashlib.sha256(path.read_bytes()).hexdigest()
            found.update(f"{name.as_posix()} {content}\n".encode())
    return found.hexdigest()[:12]
