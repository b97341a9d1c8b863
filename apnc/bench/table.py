"""The bench as a table on the console."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.table import Table


def show_bench(result: dict[str, Any]) -> None:
    """Print figures and targets of ``run_bench``."""
    table = Table(box=None, padding=(0, 2))
    for heading in ("what", "time", "against", "ratio", "target"):
        table.add_column(heading, justify="left" if heading == "what" else "right")
    for what, time_ns, against, ratio, target in _rows(result):
        table.add_row(what, _ns(time_ns), against, f"{ratio:.2f}", target)
    out = Console()
    out.print(table, highlight=False)
    size = result["fmu_bytes"] / 1000
    out.print(f"FMU with {len(result['fmu_platforms'])} platforms: {size:.0f} kB (at most 1000)")
    m = result["machine"]
    out.print(f"{m['processor']}, {m['system']}, commit {m['commit']}", highlight=False)


def _ns(value: float) -> str:
    return f"{value:.0f} ns" if value < 10_000 else f"{value / 1000:.1f} us"


def _rows(result: dict[str, Any]) -> list[tuple[str, float, str, float, str]]:
    targets = result["targets"]
    rows = [
        (
            f"core, {c['legs']} legs",
            c["core_ns"],
            f"with libm: {_ns(c['libm_ns'])}",
            c["ratio"],
            f"<= {target}" if (target := targets.get(f"core_over_libm_{c['legs']}_legs")) else "",
        )
        for c in result["core"]
    ]
    step = result["do_step"]
    rows.append(
        (
            "fmi2DoStep from C",
            step["from_c_ns"],
            f"core: {_ns(step['core_ns'])}",
            step["ratio"],
            f"<= {targets['do_step_over_core']}",
        )
    )
    rows += [
        (
            f"step of the plant, {p['legs']} legs",
            p["step_ns"],
            f"4 legs: {_ns(p['four_legs_ns'])}",
            p["ratio"],
            "",
        )
        for p in result["plant"]
    ]
    peer = result["pythonfmu"]
    if peer is None:
        return rows
    return [
        *rows,
        (
            "PythonFMU from C",
            peer["from_c_ns"],
            f"this FMU: {_ns(peer['own_from_c_ns'])}",
            peer["ratio_from_c"],
            f">= {targets['pythonfmu_over_do_step']}",
        ),
        (
            "PythonFMU through fmpy",
            peer["through_fmpy_ns"],
            f"this FMU: {_ns(peer['own_through_fmpy_ns'])}",
            peer["ratio_through_fmpy"],
            "",
        ),
    ]
