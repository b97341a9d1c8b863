"""``apnc walk --video``: what is asked for, checked before the walk, and the film after it."""
# ruff: noqa: PLC0415  # what takes seconds to import waits until it is needed

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING

from apnc.cli.console import bar, say, say_file, writable
from apnc.cli.interrupt import STOP, Interrupted
from apnc.extras import install_command

if TYPE_CHECKING:
    from apnc.film.film import Film
    from apnc.loop.record import Record


def film_of(path: Path | None, size: str | None, part: str | None, duration: float) -> Film | None:
    """The film that is asked for, after a check that it can be written.

    Args:
        path: its file; None: no film.
        size, part: see ``apnc.film.film.Film``; a part is ``BEGIN:END`` [s].
        duration: of the walk [s].

    Raises:
        ValueError: a value that is not allowed, or the extra is not installed.
    """
    if path is None:
        if size is not None or part is not None:
            name = "size" if size is not None else "part"
            raise ValueError(f"--video-{name} is taken with --video only")
        return None
    from apnc.film.film import Film

    film = Film(path, size, None if part is None else _part(part))
    for package in ("PIL", film.format.package):
        if importlib.util.find_spec(package) is None:
            raise ValueError(f"--video needs the extra 'video': {install_command('video')}")
    film.times(duration)
    writable(path, file=True)
    return film


def _part(text: str) -> tuple[float, float]:
    try:
        begin, end = map(float, text.split(":"))
    except ValueError:
        raise ValueError(f"--video-part {text} is not begin:end [s]") from None
    return begin, end


def film_walk(record: Record, film: Film) -> None:
    """Draw and write the film of a walk. An interrupt leaves no film."""
    from apnc.film.film import write_film
    from apnc.report.page import drawable
    from build_fmu.writing import write_atomically

    record = drawable(record)
    if STOP.asked or not len(record):
        say(f"no film: {'interrupted' if STOP.asked else 'nothing of the walk can be drawn'}")
        return
    try:
        film.times(record.ended_at)
    except ValueError as error:  # it ended before the part begins
        say(f"no film: {error}")
        return
    with bar("filming") as show:

        def progress(done: float, total: float) -> None:
            if STOP.asked:
                raise Interrupted(f"interrupted: {film.path} is not written; all else is")
            show(done, total, lambda x: f"{done:5.1f} s  {x:4.1f}x real time")

        write_atomically(film.path, lambda path: write_film(record, film, path, progress))
    say_file("film", film.path)
