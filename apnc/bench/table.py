"""The bench as a table on the console."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.console import Console
from rich.table import Table


def show_bench(result: dict[str, Any]) -> None:
    """Print figures and targets of ``run_bench``."""
    table = Table(box=None, padding=(0, 2))
    for heading in ("what", "time", "against", "ratio", "target"):
        table.add_column(heading, justify="left" if heading == "what" else "right")
    for what, time_ns, other, other_ns, ratio, target in _rows(result):
        table.add_row(what, _ns(time_ns), f"{other}: {_ns(other_ns)}", f"{ratio:.2f}", target)
    out = Console()
    out.print(table, highlight=False)
    size = result["fmu_bytes"] / 1000
    out.print(f"FMU with {len(result['fmu_platforms'])} platforms: {size:.0f} kB (at most 1000)")
    m = result["machine"]
    out.print(f"{m['processor']}, {m['system']}, commit {m['commit']}", highlight=False)


def _ns(value: float) -> str:
    return f"{value:.0f} ns" if value < 10_000 else f"{value / 1000:.1f} us"


def _rows(result: dict[str, Any]) -> Iterator[tuple[str, float, str, float, float, str]]:
    """What was timed against what, their times, the ratio and its target."""
    targets, step, peer = result["targets"], result["do_step"], result["pythonfmu"]
    for c in result["core"]:
        target = targets.get(f"core_over_libm_{c['legs']}_legs")
        most = f"<= {target}" if target else ""
        yield f"core, {c['legs']} legs", c["core_ns"], "with libm", c["libm_ns"], c["ratio"], most
    most = f"<= {targets['do_step_over_core']}"
    yield "fmi2DoStep from C", step["from_c_ns"], "core", step["core_ns"], step["ratio"], most
    for p in result["plant"]:
        title = f"step of the plant, {p['legs']} legs"
        yield title, p["step_ns"], "4 legs", p["four_legs_ns"], p["ratio"], ""
    least = f">= {targets['pythonfmu_over_do_step']}"
    for way, bound in (("from C", least), ("through fmpy", "")) if peer else ():
        key = way.lower().replace(" ", "_")
        times = peer[f"{key}_ns"], "this FMU", peer[f"own_{key}_ns"]
        yield f"PythonFMU {way}", *times, peer[f"ratio_{key}"], bound
