"""Runs the commands of the search, with one line for an error and a progress bar."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

import typer
from rich.console import Console
from rich.progress import track

Item = TypeVar("Item")


def run(command: Callable[..., None]) -> None:
    """Run a command. An error of the input is printed in one line and exits with code 2."""
    try:
        typer.run(command)
    except (ValueError, RuntimeError, OSError) as error:
        typer.echo(f"error: {error}", err=True)
        raise SystemExit(2) from None


def tracked(items: Iterable[Item], total: int, what: str) -> Iterable[Item]:
    """The items, with a progress bar and the estimated time left on stderr."""
    return track(items, what, total, console=Console(stderr=True))
