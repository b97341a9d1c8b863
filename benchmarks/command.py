"""The command line that every benchmark has."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

from benchmarks.machine import load, machine
from benchmarks.rows import Row, markdown


@dataclass(frozen=True)
class Size:
    """How much is measured.

    Args:
        rounds: of everything that is measured in turn.
        duration: of a walk [s].
        core: where what has one thread stays; -1: anywhere.
        before: Python of an environment with another version of the product, to compare with.
        quick: whether only to see that it works.
    """

    rounds: int = 10
    duration: float = 45.0
    core: int = -1
    before: Path | None = None
    quick: bool = False


QUICK: Final = Size(rounds=1, duration=1.0, quick=True)

Benchmark = Callable[[Size], Sequence[Row]]


def main(benchmarks: Mapping[str, Benchmark], about: str | None) -> None:
    """Measure, print a table for each, write JSON where wanted.

    Args:
        benchmarks: what is measured, by name.
        about: what they are.
    """
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--rounds", type=int, help="of everything that is measured in turn")
    parser.add_argument("--quick", action="store_true", help="see that it works, in seconds")
    parser.add_argument("--json", type=Path, help="write every figure of every round here")
    parser.add_argument(
        "--core", type=int, default=(os.cpu_count() or 1) - 1,
        help="where what has one thread stays, the last one if omitted; -1: anywhere",
    )  # fmt: skip
    parser.add_argument(
        "--before", type=Path, metavar="PYTHON",
        help="of an environment with another version of the product, to compare with",
    )  # fmt: skip
    parser.add_argument("--only", nargs="+", choices=list(benchmarks), default=list(benchmarks))
    options = parser.parse_args()
    size = replace(QUICK if options.quick else Size(), core=options.core, before=options.before)
    if options.rounds is not None:
        if options.rounds < 1:
            parser.error(f"--rounds {options.rounds}: allowed: 1 and more")
        size = replace(size, rounds=options.rounds)
    found: dict[str, Any] = {"machine": machine() | {"core": str(size.core)}, "tables": {}}
    for key, value in found["machine"].items():
        print(f"- {key}: {value}")
    if size.quick:
        print("\nQuick: the figures mean nothing.")
    aimed_at: list[Row] = []
    for name in options.only:
        print(f"measuring: {name}", file=sys.stderr, flush=True)
        before = load()
        rows = benchmarks[name](size)
        loads = f"Load {before} before, {load()} after."
        print(f"\n## {name}\n\n{loads}\n\n{markdown(rows)}", flush=True)
        aimed_at += [replace(row, what=f"{name}: {row.what}") for row in rows if row.aim]
        found["tables"][name] = {"load": loads, "rows": [row.to_dict() for row in rows]}
        if options.json:
            options.json.write_text(json.dumps(found, indent=2) + "\n")
    if len(options.only) > 1:
        print(f"\n## What has an aim\n\n{markdown(aimed_at)}")
