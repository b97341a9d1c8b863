"""The closed loop in Exudyn as another version of the product has it, in a process of its own."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

NAME: Final = "Exudyn before"

_SERVER: Final = """
import sys, time
import apnc

answers, sys.stdout = sys.stdout, sys.stderr  # whatever an import prints is no answer
for line in sys.stdin:
    begin = time.process_time()
    record = apnc.simulate(apnc.Experiment(duration=float(line)))
    spent = time.process_time() - begin
    print(spent if record.complete else "nan", file=answers, flush=True)
"""


class Before:
    """A Python whose ``apnc`` is the other version; a walk at a time."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def walk_s(self, duration: float) -> float:
        """Time of the processor for a walk of Lilibot at MI 0.08 with its record [s].

        Raises:
            RuntimeError: the other version did not walk it to its end.
        """
        asked, answered = self._process.stdin, self._process.stdout
        assert asked is not None and answered is not None
        print(duration, file=asked, flush=True)
        answer = answered.readline().strip()
        if not answer or answer == "nan":
            raise RuntimeError(f"{NAME}: no walk of {duration} s")
        return float(answer)


@contextmanager
def before(python: Path) -> Iterator[Before]:
    """The other version, as long as it is needed.

    Args:
        python: interpreter of an environment where that version is installed.
    """
    with subprocess.Popen(
        [str(python), "-P", "-c", _SERVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        yield Before(process)
