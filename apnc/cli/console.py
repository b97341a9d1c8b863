"""What the command line prints, and checks of the files that it is about to write."""
# ruff: noqa: PLC0415  # rich takes a tenth of a second

from __future__ import annotations

import logging
import os
import sys
import tempfile
import textwrap
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import count as counting
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import typer

if TYPE_CHECKING:
    from rich.status import Status


_GAP: Final = 2
"""Spaces between the columns of a table."""

_INDENT: Final = 4
"""Spaces before text that is below its row."""

_LEAST_TEXT: Final = 40
"""Width of the narrowest column that text is wrapped in [characters]."""


def writable(path: Path, *, file: bool = False) -> Path:
    """Check that a folder or file can be written, before anything is computed, and make the folder.

    Args:
        path: the folder, or the file.
        file: whether the path is a file.

    Returns:
        The path.

    Raises:
        ValueError: the folder cannot be made or written, or the file is a folder.
    """
    folder = path.parent if file else path
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise ValueError(f"output folder {folder} cannot be written: {error.strerror}") from None
    if file and path.is_dir():
        raise ValueError(f"file {path} is a folder")
    return path


def file_option(about: str, *names: str) -> Any:
    """An option that names a file to write.

    Args:
        about: help text.
        names: names of the option, where they differ from its parameter.
    """
    return typer.Option(*names, help=about, parser=file_path, metavar="<file>")


def file_path(text: str | Path) -> Path:
    """The path of a file.

    Raises:
        BadParameter: the text ends in a slash, as the path of a folder does.
    """
    if str(text).endswith(("/", os.sep)):
        raise typer.BadParameter(f"{text} is a folder; allowed: a file")
    return Path(text)


def given(**options: str | Path | None) -> dict[str, list[Path]]:
    """Files of the options that were given, by option."""
    return {f"--{name}": [Path(file)] for name, file in options.items() if file is not None}


def apart(outputs: Mapping[str, Path | None], others: Mapping[str, Iterable[Path]]) -> None:
    """Refuse outputs that would overwrite each other or a file that is read.

    Args:
        outputs: file that each option writes; None if the option was not given.
        others: files of other options, written or read.

    Raises:
        ValueError: two of them are one file.
    """
    taken = dict(others)
    for option, path in outputs.items():
        if path is None:
            continue
        for name, paths in taken.items():
            if any(_same(path, other) for other in paths):
                raise ValueError(f"{option} {path} would overwrite a file of {name}")
        taken[option] = [path]


def _same(a: Path, b: Path) -> bool:
    return a.samefile(b) if a.exists() and b.exists() else a.resolve() == b.resolve()


def say(text: str, *, error: bool = False) -> None:
    """Print a line as it is, however long."""
    print(text, file=sys.stderr if error else sys.stdout, flush=True)


def status(text: str) -> Status:
    """Text shown on the console while the with statement runs."""
    from rich.console import Console

    return Console(stderr=True).status(text)


def compiling(shown: Status, count: int) -> Callable[[str], None]:
    """A progress that names in ``shown`` which of ``count`` platforms is compiled."""
    number = counting(1)
    return lambda name: shown.update(f"compiling for {name}, {next(number)} of {count}")


class Told(logging.Handler):
    """Prints what is logged as lines on standard error, above a spinner or a bar."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print the message of a record."""
        say(self.format(record), error=True)


def tell_compiling() -> None:
    """Say on standard error what is compiled, and how long it took, wherever that happens."""
    log = logging.getLogger("build_fmu")
    log.setLevel(logging.INFO)
    if not any(isinstance(handler, Told) for handler in log.handlers):
        log.addHandler(Told())


def say_file(label: str, path: Path) -> None:
    """Print where a file is. In a terminal that knows links, the path opens the file."""
    from rich.console import Console
    from rich.text import Text

    link = f"link {path.absolute().as_uri()}"
    Console().print(Text.assemble(f"{label}: ", (str(path), link)), soft_wrap=True)


def show_table(rows: Iterable[Iterable[str]], *headings: str) -> None:
    """Print rows as a table whose last column is text. In a pipe no line is broken.

    Text too long for its row is wrapped in its column, or is below its row where the column would
    have less than 40 characters.
    """
    from rich.cells import cell_len
    from rich.console import Console
    from rich.text import Text

    lines = [*([headings] if headings else []), *map(tuple, rows)]
    *widths, text = (max(map(cell_len, column)) for column in zip(*lines, strict=True))
    console = Console()
    window = console.width if console.is_terminal or "COLUMNS" in os.environ else sys.maxsize
    begin = sum(widths) + _GAP * len(widths)
    missing = min(text, _LEAST_TEXT) - (window - begin)
    usual = sorted(cell_len(row[-2]) for row in lines)[len(lines) // 2]
    if 0 < missing <= widths[-1] - usual:  # the few longer cells reach into the column of text
        widths[-1] -= missing
        begin -= missing
    for row in lines:
        gaps = (max(w - cell_len(c), 0) + _GAP for c, w in zip(row, widths, strict=False))
        line = "".join(cell + " " * gap for cell, gap in zip(row, gaps, strict=False))
        if cell_len(line + row[-1]) <= window:
            line += row[-1]
        elif cell_len(line) == begin and window - begin >= _LEAST_TEXT:
            line += _wrapped(row[-1], window - begin, begin).lstrip(" ")
        else:
            line = f"{line.rstrip()}\n{_wrapped(row[-1], window - _INDENT, _INDENT)}"
        style = "bold" if row is headings else ""
        console.print(Text(line.rstrip(), style), soft_wrap=True)


def _wrapped(text: str, width: int, indent: int) -> str:
    """Lines of at most ``width`` characters, each after ``indent`` spaces."""
    lines = textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False)
    return "\n".join(" " * indent + line for line in lines)


@contextmanager
def bar(
    label: str, width: int = 40
) -> Iterator[Callable[[float, float, Callable[[float], str]], None]]:
    """A progress bar with the time that remains. Before the first step it is a line of text.

    Args:
        label: text before the bar.
        width: of the bar [characters].

    Yields:
        A function to call with the simulated time that is done, its total [s], and a function that
        makes the text beside the bar of the simulated time per wall time since the first call.
    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TimeRemainingColumn

    console = Console(stderr=True)
    columns = ("{task.description}", BarColumn(width), TaskProgressColumn(), "{task.fields[state]}")
    progress = Progress(*columns, TimeRemainingColumn(), console=console)
    task = progress.add_task(label, total=None, state="")
    waiting = console.status(f"preparing: {label}")
    begin = shown = before = 0.0

    def update(done: float, total: float, state: Callable[[float], str]) -> None:
        nonlocal begin, shown, before
        now = time.perf_counter()
        if not progress.live.is_started:  # not earlier: until then an error may be printed
            waiting.stop()
            progress.start()
            begin, before = now, done
        if now - shown > 0.1 or done > total - 1e-6:
            shown, speed = now, (done - before) / max(now - begin, 1e-9)
            progress.update(task, completed=done, total=total, state=state(speed))

    waiting.start()
    try:
        yield update
    finally:
        waiting.stop()
        if progress.live.is_started:
            progress.stop()
