"""``apnc``: runs a command; a mistake is one line, and Ctrl-C is no traceback."""
# ruff: noqa: PLC0415  # not even while the command line is imported

from __future__ import annotations

import io
import sys
from typing import Final

from apnc.cli.interrupt import INTERRUPTED, NOTHING, STOP, Interrupted

BAD_USE: Final = 2


def main(arguments: list[str] | None = None) -> None:
    """Run the command line.

    Exit codes: 0 done; 1 a robot that fell, a motion that diverged, a trial that failed; 2 a
    mistake of the caller, one line on stderr; 130 interrupted.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # not every console shows Greek letters
    with STOP.listening():
        try:
            code = _run(arguments)
        except Interrupted as request:
            sys.stderr.write(f"{request}\n")
            code = INTERRUPTED
    sys.exit(code)


def _run(arguments: list[str] | None) -> int:
    try:
        import typer

        from apnc.cli.app import app

        command = typer.main.get_command(app)
        code = command.main(args=arguments, prog_name="apnc", standalone_mode=False)
    except Exception as error:
        if STOP.asked and not STOP.running:  # what an import has made of it
            raise Interrupted(NOTHING) from None
        return _explained(error)
    return code if isinstance(code, int) else 0


def _explained(error: Exception) -> int:
    if hasattr(error, "exit_code") and type(error).__name__ == "Exit":
        return int(error.exit_code)
    if hasattr(error, "format_message"):  # a usage error of the command-line library
        if type(error).__name__ == "NoArgsIsHelpError":
            error.show()  # type: ignore[attr-defined]  # known by its name, to import nothing
            return BAD_USE
        text = error.format_message()
    elif isinstance(error, ValueError | OSError | RuntimeError):
        text = str(error)
    else:
        raise error
    compiler = type(error).__name__ == "BuildError"  # what it says has several lines
    sys.stderr.write(f"apnc: {text if compiler else ' '.join(text.split())}\n")
    return BAD_USE
