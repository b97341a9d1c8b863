"""Hash of the code that a motion and its measures depend on."""

from __future__ import annotations

import hashlib
import importlib
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

# parts of apnc and of packages with studies that only show, export, document or search
_APART: Final = {"cli", "docs", "report", "system", "tune", "view", "film", "figures.py"}

ROOT: Final = Path(__file__).parents[2]


@cache
def code_hash(root: Path = ROOT) -> str:
    """Hash of names and content of the product's files below ``root``, 12 hex digits."""
    return _hash(root, _PACKAGES)


@cache
def hash_of_package(name: str) -> str:
    """Hash of a package with studies outside the product; empty for a package of the product.

    Args:
        name: of the package or of a module in it, which can be imported.
    """
    top = name.partition(".")[0]
    if top in _PACKAGES:
        return ""
    (folder,) = importlib.import_module(top).__path__
    return _hash(Path(folder).parent, (top,))


def _hash(root: Path, packages: tuple[str, ...]) -> str:
    found = hashlib.sha256()
    paths = [path for package in packages for path in (root / package).rglob("*.*")]
    for path in sorted(path for path in paths if path.suffix in _SUFFIXES):
        name = path.relative_to(root)
        whole = name.parts[0] in _PACKAGES and name.parts[0] != "apnc"
        if whole or not _APART & {*name.parts}:
            content = hashlib.sha256(path.read_bytes()).hexdigest()
            found.update(f"{name.as_posix()} {content}\n".encode())
    return found.hexdigest()[:12]
