"""The paper's experiments: ``apnc study all`` as a command."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from typing import Final

from benchmarks.command import Size, main
from benchmarks.machine import ROOT
from benchmarks.rows import Row, children_s, wall_s

WORKERS: Final = 2
MOST_S: Final = 75.0


def measure(size: Size) -> list[Row]:
    """Wall time of the command, once, and its time of the processor."""
    words = ["study", "all", "--workers", str(WORKERS)]
    words += ["--trials", "1", "--duration", "2"] if size.quick else []
    before = children_s()
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "apnc", *words, "--output", f"{folder}/study"]
        wall = wall_s(
            lambda: subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        )
    title = " ".join(["apnc", *words])
    most = None if size.quick else MOST_S
    return [
        Row(title, "s", (wall,), most=most),
        Row(f"{title}, time of the processor", "s", (children_s() - before,)),
    ]


if __name__ == "__main__":
    main({"study": measure}, __doc__)
