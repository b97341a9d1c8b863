"""The report of a tuned robot."""

from __future__ import annotations

from pathlib import Path

from apnc.tune.tuning import Tuned


def write_report(path: Path, tuned: Tuned, output: Path) -> None:
    """Write the page of a tuned robot."""
    path.write_text("", encoding="utf-8")
