"""Builds the page to play with: ``python -m play.build FILE``; it needs ziglang."""

from __future__ import annotations

import base64
import sys
from pathlib import Path
from typing import Any, Final

from play.bundle import page
from play.numbers import START, robot_data, shared_data
from play.wasm import module

ROBOTS: Final = tuple(START)
STILL: Final = Path(__file__).parents[1] / "docs" / "pictures" / "play.webp"
"""The page as it walks, which ``python -m play.still`` takes."""


def page_data() -> dict[str, Any]:
    """Everything that the page reads: robots, names, WebAssembly by number of legs."""
    robots = [robot_data(name) for name in ROBOTS]
    modules = {n: base64.b64encode(module(n)).decode() for n in {len(r["legs"]) for r in robots}}
    return {"robots": robots, "modules": modules, **shared_data()}


def build(file: Path) -> None:
    """Write the page.

    Raises:
        BuildError: the compiler failed.
        OSError: the file cannot be written.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(page(page_data(), STILL.read_bytes()), encoding="utf-8")


if __name__ == "__main__":
    build(Path(sys.argv[1]))
