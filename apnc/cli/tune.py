"""``apnc tune``: find the gait of a robot."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from typer import Argument, Option

from apnc.cli.console import apart, bar, file_option, say, say_file, show_table, writable
from apnc.cli.interrupt import STOP, Interrupted

if TYPE_CHECKING:
    from apnc.tune import Tuned, Validation
    from apnc.tune.search import Best, Count

MEASURING: Final = "the search is over; measuring what was found takes a little longer"
"""Said between the last candidate and the table."""

BAR: Final = 14
"""Width of the bar [characters]; what was found so far is beside it in a row of 80."""

QUIET_S: Final = 60.0
"""Longest time without a line where there is no terminal [s]."""


def tune(
    robot: Annotated[str, Argument(help="Robot file (TOML), or the name of a shipped robot.")],
    minutes: Annotated[
        float | None, Option(help="How long to search [min]. Default: 10, without --candidates.")
    ] = None,
    candidates: Annotated[
        int | None, Option(help="How many candidates to try: the same result on every machine.")
    ] = None,
    output: Annotated[Path, file_option("Robot file to write. Default: tuned.toml.")] = Path(
        "tuned.toml"
    ),
    seed: Annotated[int, Option(help="Seed of the optimiser and of all runs.")] = 1,
    mi: Annotated[
        str | None, Option(help="MI range to aim at, as 0.08,0.28. The search may scale it.")
    ] = None,
    paper: Annotated[
        bool,
        Option(
            "--paper", help="Judge by the paper's other experiments as well, at MI 0.04 to 0.40."
        ),
    ] = False,
    keep_servo: Annotated[
        bool, Option("--keep-servo", help="Leave stiffness and damping of the servos as they are.")
    ] = False,
    body: Annotated[
        bool, Option("--body", help="Search centre of mass, mass split, rotors and feet as well.")
    ] = False,
    keep: Annotated[
        str | None, Option(help="Variables to leave as they are, as a1,a2,stance.up.")
    ] = None,
    near: Annotated[
        bool, Option("--near", help="Stay near the robot of the file, as one tuned before.")
    ] = False,
    workers: Annotated[int | None, Option(help="Number of processes. Default: all cores.")] = None,
    scheduler: Annotated[
        str | None, Option(help="Address of a Dask scheduler, as tcp://host:8786.")
    ] = None,
    resume: Annotated[
        bool, Option("--resume", help="Go on with the search of the output.")
    ] = False,
) -> None:
    """Find the gait of a robot: search its stance and gains; write its robot file and a report.

    Ctrl-C keeps the best so far. Needs the extra tune.
    """
    from apnc.tune import Allowed, Stopped
    from apnc.tune import tune as find
    from apnc.tune.report import write_report
    from apnc.tune.tuned_file import path_of
    from build_fmu.writing import write_atomically

    if output.suffix != ".toml":
        raise ValueError(f"--output is {output}; allowed: a name that ends in .toml")
    log, page = output.with_suffix(".csv"), output.with_suffix(".html")
    apart({"--output": output}, {"the robot": [path_of(robot)]})
    _refuse_earlier((output, log, page), log, resume=resume)
    writable(output, file=True)
    with _shown() as progress:
        try:
            tuned = find(
                robot,
                minutes=minutes,
                candidates=candidates,
                seed=seed,
                mi=_range(mi) if mi is not None else None,
                paper=paper,
                allowed=Allowed(
                    servo=not keep_servo,
                    body=body,
                    kept=tuple(keep.split(",")) if keep else (),
                ),
                near=near,
                workers=workers if workers is not None else os.cpu_count() or 1,
                scheduler=scheduler,
                log=log,
                resume=resume,
                progress=progress,
                measuring=lambda: say(MEASURING, error=True),
                stop=STOP,
            )
        except Stopped:
            raise Interrupted("interrupted before a robot was found, nothing written") from None
    write_atomically(output, tuned.text.encode("utf-8"))
    write_report(page, tuned, output)
    _say(tuned, output)
    say_file("report", page)
    if STOP.asked:
        raise Interrupted(f"interrupted; {output} is the best so far, --resume goes on")


def _refuse_earlier(files: Sequence[Path], log: Path, *, resume: bool) -> None:
    """Refuse an output of an earlier search: a robot is never left beside the log of another one.

    Raises:
        ValueError: there is one, and it is not to be resumed or has no log.
    """
    there = [file for file in files if file.exists()]
    if not there or (resume and log.exists()):
        return
    names = ", ".join(map(str, there))
    if resume:
        raise ValueError(f"--resume needs the log {log}, which is missing beside {names}")
    raise ValueError(
        f"--output: an earlier search has written {names}; allowed: --resume, to go on with it, "
        "another --output, or to remove what it has written"
    )


@contextmanager
def _shown() -> Iterator[Callable[[Best, Count, float], None]]:
    """Progress of a search: a bar in a terminal, elsewhere a line now and then."""
    from apnc.tune import in_words

    if sys.stderr.isatty():
        with bar("tune", BAR) as show:
            yield lambda best, count, share: show(share, 1.0, lambda _: in_words(best))
        return
    told, last = "", -math.inf

    def tell(best: Best, count: Count, share: float) -> None:
        nonlocal told, last
        words, now = in_words(best), time.monotonic()
        if words != told or now - last >= QUIET_S or share == 1.0:
            told, last = words, now
            say(f"{share:4.0%}, {count.candidates} candidates: {words}", error=True)

    yield tell


def _range(text: str) -> tuple[float, float]:
    try:
        low, high = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f"--mi is {text}; allowed: two numbers as 0.08,0.28") from None
    return low, high


def _say(tuned: Tuned, output: Path) -> None:
    from apnc.tune.wording import lines_to_paste

    count = tuned.count
    rate = count.simulated / count.wall if count.wall > 0.0 else 0.0
    say(
        f"{count.candidates} candidates in {count.wall / 60.0:.1f} min, {rate:.0f} simulated "
        f"seconds a second; found again by\n{tuned.command}\n"
    )
    if tuned.best.x == tuned.begun_at:
        say("nothing better than the file itself was found: only its MI range and MI are set\n")
    if tuned.validation is not None:
        _say_validation(tuned.validation)
    say("")
    for _, line in lines_to_paste(output):
        say(line)


def _say_validation(found: Validation) -> None:
    from apnc.tune.validation import with_article
    from apnc.tune.wording import COLUMNS, others, table

    seeds, gait = len(found.cells[0].runs), with_article(found.gait)
    say(f"walks in {gait} that holds, of {seeds} seeds that the search has not seen")
    show_table(table(found), *COLUMNS)
    for line in others(found):
        say(line)
    missed = found.missed()
    say("\nnot reached" if missed else "\nall aims reached")
    for each in missed:
        say(f"- {each.words}")
