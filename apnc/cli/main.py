"""``apnc``: runs a command. Bad input gives one line, and Ctrl-C and SIGTERM give no traceback."""
# ruff: noqa: PLC0415  # not even while the command line is imported

from __future__ import annotations

import codecs
import io
import sys
from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

from apnc.cli.interrupt import NOTHING, STOP, Interrupted

if TYPE_CHECKING:
    import typer

BAD_USE: Final = 2


def _apnc() -> typer.Typer:
    from apnc.cli.app import app

    return app


def main(
    arguments: list[str] | None = None,
    program: str = "apnc",
    load: Callable[[], typer.Typer] = _apnc,
) -> None:
    """Run a command line.

    Args:
        arguments: words of the command line; those of the process if omitted.
        program: name of the program in messages.
        load: function that loads its commands.

    Exit codes: 0 done; 1 a robot fell, a motion diverged or a trial failed; 2 bad input, with one
    line on stderr; 130 interrupted; 143 terminated.
    """
    codecs.register_error("as_shown", _as_shown)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="as_shown")
    with STOP.listening():
        try:
            code = _run(sys.argv[1:] if arguments is None else arguments, program, load)
        except Interrupted as request:
            sys.stderr.write(f"{request}\n")
            code = STOP.code
    sys.exit(code)


def _as_shown(error: UnicodeError) -> tuple[str, int]:
    """Replacement of characters that the console cannot show, such as Greek letters."""
    assert isinstance(error, UnicodeEncodeError)
    lost = error.object[error.start : error.end]
    return "".join(" " if letter.isspace() else "?" for letter in lost), error.end


def _refuse_empty(words: list[str]) -> None:
    """Refuse empty values: an empty path would mean the present folder."""
    for before, word in pairwise(("argument", *words)):
        if word == "" or (word.startswith("--") and word.endswith("=")):
            raise ValueError(f"{(word or before).removesuffix('=')} is empty")


def _run(arguments: list[str], program: str, load: Callable[[], typer.Typer]) -> int:
    try:
        _refuse_empty(arguments)
        import typer

        from apnc.cli.console import tell_compiling

        tell_compiling()
        command = typer.main.get_command(load())
        code = command.main(args=arguments, prog_name=program, standalone_mode=False)
    except Exception as error:
        if STOP.asked and not STOP.running:  # what an import has made of it
            raise Interrupted(NOTHING) from None
        return _explained(error, program)
    return code if isinstance(code, int) else 0


_ASKED: Final = {"float_parsing": "a number", "int_parsing": "a whole number"}
"""What an option takes, by the kind of error that pydantic finds in its value."""


def _say_value(error: Any) -> None:
    """Name the value, and what is allowed, in a usage error from a number that cannot be read."""
    found: list[Any] = getattr(error.__cause__, "errors", list)()
    if found and found[0]["type"] in _ASKED:
        error.message = f"{found[0]['input']!r}; allowed: {_ASKED[found[0]['type']]}"


def _explained(error: Exception, program: str) -> int:
    if hasattr(error, "exit_code") and type(error).__name__ == "Exit":
        return int(error.exit_code)
    if hasattr(error, "format_message"):  # a usage error of the command-line library
        if type(error).__name__ == "NoArgsIsHelpError":
            error.show()  # type: ignore[attr-defined]  # known by its name, to import nothing
            return BAD_USE
        _say_value(error)
        text = error.format_message()
    elif isinstance(error, ValueError | OSError | RuntimeError):
        text = str(error)
    else:
        raise error
    compiler = type(error).__name__ == "BuildError"  # what it says has several lines
    sys.stderr.write(f"{program}: {text if compiler else ' '.join(text.split())}\n")
    return BAD_USE
