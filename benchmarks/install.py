"""A fresh environment without a compiler: what it weighs, and the first walks in it.

What is installed is the last commit, not what was changed since.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from benchmarks.command import Size, main
from benchmarks.machine import ROOT
from benchmarks.rows import Row
from benchmarks.walk_command import rows_of

MOST_MB: Final = 330.0

LIGHT_MB: Final = 1.0
"""Packages that weigh less are counted together."""

_WEIGH: Final = """
import importlib.metadata, json

weights = {}
for package in importlib.metadata.distributions():
    paths = [file.locate() for file in package.files or () if "__pycache__" not in file.parts]
    weights[package.name] = sum(path.stat().st_size for path in paths if path.is_file())
print(json.dumps(weights))
"""
_OF_PYTHON: Final = ("pip", "setuptools", "wheel")


def measure(size: Size) -> list[Row]:
    """Weight by package [MB], and time of ``apnc walk``."""
    with tempfile.TemporaryDirectory(prefix="apnc-install-") as folder:
        python = installed(Path(folder))
        # -P: what is installed, and not what lies in the folder that it is called from
        words = [str(python), "-P", "-m", "apnc"]
        variables = os.environ | {"APNC_CACHE": f"{folder}/cache"}
        return [*weights(python), *rows_of(words, size, variables)]


def installed(folder: Path) -> Path:
    """Python of a new environment with the last commit installed."""
    clone, environment = folder / "clone", folder / "venv"
    python = environment / ("Scripts" if os.name == "nt" else "bin") / "python"
    for line in (
        ["git", "clone", "-q", str(ROOT), str(clone)],
        [sys.executable, "-m", "venv", str(environment)],
        [str(python), "-m", "pip", "install", "-q", str(clone)],
    ):
        subprocess.run(line, check=True, stderr=subprocess.DEVNULL)
    return python


def weights(python: Path) -> list[Row]:
    """Rows of what is installed, without compiled ``.pyc`` files."""
    done = subprocess.run(
        [str(python), "-P", "-c", _WEIGH], check=True, capture_output=True, text=True
    )
    found = {k: v / 1e6 for k, v in json.loads(done.stdout).items() if k not in _OF_PYTHON}
    heavy = {k: v for k, v in found.items() if v >= LIGHT_MB}
    heavy = dict(sorted(heavy.items(), key=lambda item: -item[1]))
    heavy["all lighter ones"] = sum(found.values()) - sum(heavy.values())
    total = Row("default install", "MB", (sum(found.values()),), most=MOST_MB)
    return [total, *(Row(f"- {name}", "MB", (value,)) for name, value in heavy.items())]


if __name__ == "__main__":
    main({"install": measure}, __doc__)
