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

from apnc_studies.report.wording import rows
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
    table.add_column(no_wrap=True)
    table.add_column(no_wrap=True)
    table.add_column()
    for label, text, meaning in rows(summary):
        table.add_row(label, text, f"[dim]{meaning}[/dim]")
    out.print(table, highlight=False)
    out.print(f"report: {folder}/report.html", highlight=False, soft_wrap=True)
