"""``apnc tune``: find the gait of a robot."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import os
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from apnc.cli.console import apart, bar, file_option, say, say_file, show_table, writable
from apnc.cli.interrupt import STOP, Interrupted

if TYPE_CHECKING:
    from apnc.tune import Tuned, Validation
    from apnc.tune.search import Best, Count


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
    keep_servo: Annotated[
        bool, Option("--keep-servo", help="Leave stiffness and damping of the servos as they are.")
    ] = False,
    body: Annotated[
        bool, Option("--body", help="Search centre of mass, mass split, rotors and feet as well.")
    ] = False,
    workers: Annotated[int | None, Option(help="Number of threads. Default: all cores.")] = None,
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
    from apnc.tune import MI_AIMED, Allowed, in_words
    from apnc.tune import tune as find
    from apnc.tune.report import write_report

    if output.suffix != ".toml":
        raise ValueError(f"--output is {output}; allowed: a name that ends in .toml")
    log, page = output.with_suffix(".csv"), output.with_suffix(".html")
    from apnc.tune.tuned_file import path_of

    apart({"--output": output}, {"the robot": [path_of(robot)]})
    writable(output, file=True)
    with bar(f"tune {Path(robot).stem}") as show:

        def progress(best: Best, count: Count, share: float) -> None:
            words = in_words(best)
            show(share, 1.0, lambda _: f"{count.candidates} candidates, {words}")

        tuned = find(
            robot,
            minutes=minutes,
            candidates=candidates,
            seed=seed,
            mi=_range(mi) if mi is not None else MI_AIMED,
            allowed=Allowed(servo=not keep_servo, body=body),
            workers=workers if workers is not None else os.cpu_count() or 1,
            scheduler=scheduler,
            log=log,
            resume=resume,
            progress=progress,
            stop=STOP,
        )
    output.write_text(tuned.text, encoding="utf-8")
    _say(tuned, output)
    if tuned.validation is not None:
        write_report(page, tuned, output)
        say_file("report", page)
    if STOP.asked:
        raise Interrupted("interrupted; --resume goes on with the search")


def _range(text: str) -> tuple[float, float]:
    try:
        low, high = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f"--mi is {text}; allowed: two numbers as 0.08,0.28") from None
    return low, high


def _say(tuned: Tuned, output: Path) -> None:
    count = tuned.count
    rate = count.simulated / count.wall if count.wall > 0.0 else 0.0
    say(
        f"{count.candidates} candidates in {count.wall / 60.0:.1f} min, {rate:.0f} simulated seconds"
        f" a second; found again by\n{tuned.command}\n"
    )
    if tuned.validation is not None:
        _say_validation(tuned.validation)
    say("")
    for line in lines_to_paste(output):
        say(line)


def lines_to_paste(output: Path) -> tuple[str, ...]:
    """Commands that walk a tuned robot, study it and build its FMU."""
    name = shlex.quote(str(output))
    return (
        f"apnc walk --robot {name} --engine compiled",
        f"apnc study mi --robot {name} --trials 3",
        f"apnc build --robot {name}",
    )


def _say_validation(found: Validation) -> None:
    seeds = len(found.cells[0].runs)
    say(f"walks in a {found.gait} that holds, of {seeds} seeds that the search has not seen")
    kinds = ("walk", "apc", "varied")
    columns = {kind: {cell.mi: cell for cell in found.of(kind)} for kind in kinds}
    show_table(
        (
            [
                f"{mi:.3g}",
                *(str(columns[kind][mi].good) for kind in kinds),
                f"{cell.time * found.time:.1f}",
                f"{cell.middle('speed') * found.speed:.3f}",
                f"{1e3 * cell.middle('lift') * found.length:.1f}",
                f"{100.0 * cell.middle('slip'):.0f}",
            ]
            for mi, cell in columns["walk"].items()
        ),
        "MI", "with ANC", "APC alone", "body off by 10 %", "after [s]", "m/s", "lift [mm]",
        "slip [%]",
    )  # fmt: skip
    for kind, words in (
        ("payload", "payload of a fifth of its mass"),
        ("sensor", "one foot sensor dead"),
        ("air", "let down from the air"),
    ):
        for cell in found.of(kind):
            say(f"{words}, MI {cell.mi:.3g}: {cell.good} of {len(cell.runs)}")
    missed = found.missed()
    say("\nnot reached" if missed else "\nall aims reached")
    for line in missed:
        say(f"- {line}")
