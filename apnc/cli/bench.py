"""``apnc bench``: what a tick of the controller costs."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

from apnc.cli.console import file_option, say, status, writable


def bench(
    output: Annotated[Path, file_option("JSON file to write.")] = Path("apnc-bench.json"),
) -> None:
    """Measure what a tick costs, against its arithmetic and against PythonFMU."""
    writable(output, file=True)
    with status("measuring") as shown:
        from apnc.bench.run import run_bench
        from apnc.bench.table import show_bench

        result = run_bench(lambda what: shown.update(f"measuring: {what}"))
    output.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    show_bench(result)
    say(f"all figures: {output}")
