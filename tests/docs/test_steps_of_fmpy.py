"""Every run in FMPy that is shown gives the interval: FMPy chooses a longer step by itself."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHOWN = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("*.py")]
CALL = re.compile(r"^.*simulate_fmu\((?:[^\n]+\)|\n(?: .*\n)*\))|^fmpy simulate .*", re.MULTILINE)


def test_every_run_gives_its_interval() -> None:
    calls = [(path.name, call) for path in SHOWN for call in CALL.findall(path.read_text("utf-8"))]
    assert {name for name, _ in calls} >= {"using.md", "importing.md"}
    assert [each for each in calls if not re.search("output[-_]interval", each[1])] == []
