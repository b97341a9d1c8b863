"""``python -m research.NAME``: a study with the options of ``apnc study``."""

from __future__ import annotations

import typer

from apnc.cli.main import main as run_app
from apnc.cli.study import about, command_of
from research.registry import STUDIES


def main(name: str) -> None:
    """Run the command line of a study. Exit codes are those of ``apnc``."""
    entry = STUDIES[name]
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
    command = command_of(name, entry.options, STUDIES, folder=f"apnc-research-{name}")
    app.command(help=about(entry))(command)
    run_app(program=f"python -m research.{name}", load=lambda: app)
