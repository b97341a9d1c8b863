"""Files that are written whole or not at all."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from build_fmu.locks import one_at_a_time

Write = Callable[[Path], object]
"""Writes a file to the path it is given."""

_ASIDE: Final = ".writing-"

LEFT_S: Final = 86400.0
"""Age from which on a folder aside counts as left by a killed writer: no file takes a day [s]."""


def write_atomically(path: Path, content: bytes | Write) -> None:
    """Write a file at once: neither a reader nor a second writer ever sees a part of it.

    Args:
        path: the file; its folder is made if missing.
        content: the bytes, or what writes them.

    Raises:
        OSError: the file cannot be written; it is named, and an older one stays as it was.
    """
    with _aside(path.parent) as aside, _naming(path):
        part = aside / path.name
        if isinstance(content, bytes):
            part.write_bytes(content)
        else:
            content(part)
        part.replace(path)


def write_together(folder: Path, files: Mapping[str, Write]) -> None:
    """Write files aside and put them in place when all of them are whole.

    Any number may write to a folder at a time; of those that write the same files the last one's
    stay, all of them.

    Args:
        folder: made if missing.
        files: what writes each file, by its name in the folder.

    Raises:
        OSError: a file cannot be written; it names the file, and the folder is as it was before.
    """
    with _aside(folder) as aside:
        for name, write in files.items():
            with _naming(folder / name):
                write(aside / name)
        with one_at_a_time(folder):
            _exchange(aside, folder, list(files))


@contextmanager
def _aside(folder: Path) -> Iterator[Path]:
    """A new folder in ``folder``, removed at the end of the with statement."""
    folder.mkdir(parents=True, exist_ok=True)
    aside = Path(tempfile.mkdtemp(prefix=_ASIDE, dir=folder))
    try:
        _remove_what_was_left(folder, aside.stat().st_mtime)
        yield aside
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _remove_what_was_left(folder: Path, now: float) -> None:
    """Remove what killed writers left aside, by the clock of the file system."""
    for left in folder.glob(f"{_ASIDE}*"):
        with suppress(OSError):  # another has removed it
            if now - left.stat().st_mtime > LEFT_S:
                shutil.rmtree(left, ignore_errors=True)


def _exchange(aside: Path, folder: Path, names: list[str]) -> None:
    """Move the new files in; the older ones leave first, so that the two never stand together."""
    older = aside / "older"
    older.mkdir()
    done: list[tuple[Path, Path]] = []
    present = [name for name in names if (folder / name).exists()]
    moves = [(folder / name, older / name) for name in present]
    moves += [(aside / name, folder / name) for name in names]
    try:
        for source, target in moves:
            with _naming(folder / source.name):
                source.rename(target)
            done.append((source, target))
    except BaseException:
        for source, target in reversed(done):
            target.rename(source)
        raise


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Says in an error of the file system which file it was, by the name it was to have."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error
