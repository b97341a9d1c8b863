"""What the command line shows: progress, tables and one line per mistake."""

from __future__ import annotations

import signal
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
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

from apnc.report.wording import rows
from apnc.summary import Summary

out = Console()
err = Console(stderr=True)

BAD_USE = 2
INTERRUPTED = 130


def writable(folder: Path) -> Path:
    """``folder``, made and proved writable before anything is computed.

    Raises:
        ValueError: it cannot be made or written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise ValueError(f"output folder {folder} cannot be written: {error.strerror}") from None
    return folder


def writable_file(path: Path) -> Path:
    """``path``, whose folder is made and proved writable.

    Raises:
        ValueError: it is a folder, or its folder cannot be written.
    """
    if path.is_dir():
        raise ValueError(f"file {path} is a folder")
    writable(path.parent)
    return path


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


@contextmanager
def study_bar(name: str, trials: int, simulated: float) -> Iterator[Any]:
    """Progress bar of a study; yields the function to call with trials and time [s] done."""
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TextColumn("{task.fields[state]}"),
        TimeRemainingColumn(),
        console=err,
    )
    task = bar.add_task(name, total=simulated, state="")
    begin, before = time.perf_counter(), None

    def update(done: int, reached: float) -> None:
        nonlocal before
        before = reached if before is None else before  # what an earlier run had finished
        speed = (reached - before) / (time.perf_counter() - begin)
        state = f"{done} of {trials} trials  {speed:.0f} simulated s/s"
        bar.update(task, completed=reached, state=state)

    with bar:
        yield update


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
