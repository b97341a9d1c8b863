"""What the command line shows: progress, tables and one line per mistake."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import (
    BarColumn,
    Progress,
    TaskProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from apnc_studies.summary import Summary

out = Console()
err = Console(stderr=True)


class StopRequest:
    """Turns the first Ctrl-C into a request to stop at the next tick; the second one interrupts."""

    def __init__(self) -> None:
        self.asked = False

    def __call__(self) -> bool:
        """Whether a stop was asked for."""
        return self.asked

    @contextmanager
    def listening(self) -> Iterator[StopRequest]:
        """Listen to Ctrl-C inside the with statement."""

        def ask(_signal: int, _frame: FrameType | None) -> None:
            self.asked = True
            signal.signal(signal.SIGINT, before)

        before = signal.signal(signal.SIGINT, ask)
        try:
            yield self
        finally:
            signal.signal(signal.SIGINT, before)


@contextmanager
def walking_bar(duration: float) -> Iterator[Any]:
    """Progress bar of a walk; yields the function to call with the time [s] and the controller."""
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TextColumn("{task.fields[state]}"),
        TimeRemainingColumn(),
        console=err,
        refresh_per_second=8,
    )
    task = bar.add_task("walking", total=duration, state="")
    begin = shown = time.perf_counter()

    def update(t: float, controller: Any) -> None:
        nonlocal shown
        if not bar.live.is_started:  # not before the first tick: until then mistakes may show
            bar.start()
        now = time.perf_counter()
        if now - shown < 0.1 and t < duration - 1e-6:
            return
        shown = now
        phases = " ".join(f"{angle:5.2f}" for angle in np.atleast_1d(controller.phi))
        state = f"{t:5.1f} s  {t / (now - begin):4.1f}x real time  phi {phases} rad"
        bar.update(task, completed=t, state=state)

    try:
        yield update
    finally:
        if bar.live.is_started:
            bar.stop()


def show_summary(summary: Summary, folder: str) -> None:
    """Print the key figures and where the files are."""
    table = Table(show_header=False, box=None, padding=(0, 2))
    for label, text in summary_rows(summary):
        table.add_row(label, text)
    out.print(table)
    out.print(f"report: {folder}/report.html", highlight=False, soft_wrap=True)


def _figure(value: float | None, unit: str, digits: int = 2) -> str:
    return "-" if value is None else f"{value:.{digits}f} {unit}".strip()


def summary_rows(s: Summary) -> list[tuple[str, str]]:
    """Label and text of every printed figure."""
    fallen = "fell" if s.fell else "upright"
    early = "" if s.complete else ", ended early"
    trot = "not known" if s.converged is None else "yes" if s.converged else "no"
    when = f", after {s.convergence_time_s:.1f} s" if s.convergence_time_s is not None else ""
    return [
        ("simulated", f"{s.duration_s:.1f} s, {fallen}{early}"),
        ("trot formed and kept", trot + when),
        ("by the authors' criterion", _figure(s.convergence_time_authors_s, "s", 1)),
        ("relative phases at the end", " ".join(_figure(p, "") for p in s.phi_final) + " rad"),
        ("forward speed", _figure(s.speed_m_per_s, "m/s", 3)),
        ("duty factor", "  ".join(f"{k} {_figure(v, '')}" for k, v in s.duty_factor.items())),
        ("balance", _figure(s.balance, "1/rad", 1)),
        ("coordination", _figure(s.coordination, "", 1)),
        ("cost of transport", _figure(s.cost_of_transport, "")),
        ("real-time factor", _figure(s.real_time_factor, "", 1)),
    ]
