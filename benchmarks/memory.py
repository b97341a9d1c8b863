"""Memory of many walks at once, of which only the summaries are kept."""

from __future__ import annotations

import subprocess
import sys
from typing import Final

from benchmarks.command import Size, main
from benchmarks.machine import ROOT
from benchmarks.rows import Row

WALKS: Final = 1000
WORKERS: Final = 2
MOST_MB: Final = 200.0

_PROGRAM: Final = """
import resource, sys
from pathlib import Path
import apnc

walks, duration, workers = int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
apnc.simulate_many(
    [apnc.Experiment(engine="compiled", duration=duration, seed=seed) for seed in range(walks)],
    workers=workers,
)
# getrusage also counts what the parent had when this process was started
status = Path("/proc/self/status")
if status.is_file():
    (line,) = (line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    print(int(line.split()[1]) * 1024)
else:
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(most if sys.platform == "darwin" else most * 1024)
"""


def most_mb(walks: int, duration: float, workers: int) -> float:
    """Most memory that a process has had which walks and keeps the summaries [MB]."""
    command = [sys.executable, "-c", _PROGRAM, str(walks), str(duration), str(workers)]
    done = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    return int(done.stdout) / 1e6


def measure(size: Size) -> list[Row]:
    """Most memory of the whole process; a run of each."""
    walks = 20 if size.quick else WALKS
    title = f"walks of {size.duration:g} s, summaries, {WORKERS} workers"
    return [
        Row(f"1 of the {title}", "MB", (most_mb(1, size.duration, WORKERS),)),
        Row(
            f"{walks} {title}", "MB", (most_mb(walks, size.duration, WORKERS),), most=MOST_MB,
        ),
    ]  # fmt: skip


if __name__ == "__main__":
    main({"memory": measure}, __doc__)
