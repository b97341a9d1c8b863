"""``apnc walk`` as a command, from its start to its end."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from typing import Final

from benchmarks.command import Size, main
from benchmarks.machine import ROOT
from benchmarks.rows import Row, children_s, wall_s

MOST_S: Final = {"compiled": 2.5, "exudyn": 5.0}
"""What the command may take, by engine [s]."""


def command(
    words: Sequence[str], engine: str, size: Size, environment: Mapping[str, str] | None = None
) -> tuple[float, float]:
    """Wall time and time of the processor of ``apnc walk`` [s].

    Args:
        words: how the command is called.
        engine: that walks.
        size: says how long.
        environment: variables of the process; this one's if omitted.
    """
    with tempfile.TemporaryDirectory() as folder:
        options = ["--engine", engine, "--duration", str(size.duration), "--output", folder]
        line, begin = [*words, "walk", *options], children_s()
        wall = wall_s(
            lambda: subprocess.run(line, cwd=ROOT, env=environment, check=True, capture_output=True)
        )
    return wall, children_s() - begin


def rows_of(
    words: Sequence[str], size: Size, environment: Mapping[str, str] | None = None
) -> list[Row]:
    """Rows of the command in both engines, in turn: first runs, and those that follow."""
    found: dict[str, list[tuple[float, float]]] = {engine: [] for engine in MOST_S}
    for index in range(size.rounds + 1):
        for engine in list(MOST_S)[:: 1 if index % 2 == 0 else -1]:
            found[engine].append(command(words, engine, size, environment))
    unit = f"s for {size.duration:g} s"
    rows = []
    for run, of in (("first", slice(1)), ("later", slice(1, None))):
        for engine, times in found.items():
            walls, spent = zip(*times[of], strict=True)
            title = f"{run} apnc walk --engine {engine}"
            rows += [
                Row(title, unit, walls, most=MOST_S[engine]),
                Row(f"{title}, time of the processor", unit, spent),
            ]
    return rows


def measure(size: Size) -> list[Row]:
    """Time of the command of this checkout."""
    return rows_of([sys.executable, "-m", "apnc"], size)


if __name__ == "__main__":
    main({"walk_command": measure}, __doc__)
