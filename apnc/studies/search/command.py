"""How the two commands of the search run: errors of input as one line, a bar over long work."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

import typer
from rich.console import Console
from rich.progress import track

Item = TypeVar("Item")


def run(command: Callable[..., None]) -> None:
    """Run a command; what is wrong with its input is one line, and exit code 2."""
    try:
        typer.run(command)
    except (ValueError, RuntimeError, OSError) as error:
        typer.echo(f"error: {error}", err=True)
        raise SystemExit(2) from None


def tracked(items: Iterable[Item], total: int, what: str) -> Iterable[Item]:
    """The items, with a bar and an estimate on stderr."""
    return track(items, what, total, console=Console(stderr=True))
