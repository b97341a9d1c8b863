"""``apnc study``: a command for every study of the registry."""
# what takes seconds to import waits until it is needed

from __future__ import annotations

import inspect
import os
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer
from typer import Option

import apnc
from apnc.cli.completion import Completion, axis_of, robots
from apnc.cli.console import bar, say, say_file, writable
from apnc.cli.interrupt import STOP, Interrupted
from apnc.studies.registry import (
    ALL,
    CONTROLLERS_OPTION,
    MIN_SEEDS,
    ROBOT,
    STUDIES,
    Entry,
    Registry,
    names_of,
)

if TYPE_CHECKING:
    from apnc.studies.results import Result

_ABOUT: Final = {ROBOT: "Robot name or TOML file. Default: that of the study."}

_TRIALS: Final = (
    f"Number of seeds per cell of the grid. A claim needs {MIN_SEEDS} of each controller for a "
    "verdict; most baselines walk half of the seeds."
)

_ENDED: Final = {"error": "ended with an error"}
_BY_NAME: Final = inspect.Parameter.KEYWORD_ONLY

TRIAL_FAILED: Final = 1
"""Exit code if a trial ended with an error."""

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Run a study and write its table, figures and claims.",
)


def command_of(
    name: str, axes: tuple[str, ...], studies: Registry, folder: str
) -> Callable[..., None]:
    """The command that runs a study.

    Args:
        name: of the study, or ``all``.
        axes: its options besides those that all studies have.
        studies: registry in which the name is looked up.
        folder: default folder for the results.
    """

    def command(**options: Any) -> None:
        _run(name, axes, studies=studies, **options)

    def option(
        option: str, kind: Any, default: Any, about: str, values: Completion | None = None
    ) -> inspect.Parameter:
        form = Annotated[kind, Option(f"--{option}", help=about, autocompletion=values)]
        return inspect.Parameter(option, _BY_NAME, default=default, annotation=form)

    parameters = [
        option("trials", int, 20, _TRIALS),
        option(
            "duration",
            float | None,
            None,
            "Simulated time of a trial [s]. Default: that of the study.",
        ),
        option("workers", int | None, None, "Number of threads. Default: all cores."),
        option("scheduler", str | None, None, "Address of a Dask scheduler, as tcp://host:8786."),
        option("output", Path, Path(folder), "Folder for the results."),
        option("resume", bool, False, "Continue the study in the output folder."),
        option("series", bool, False, "Keep the record of every trial."),
        *(
            option(
                axis,
                str | None,
                None,
                _ABOUT.get(axis, "Values to run, separated by commas. Default: all."),
                robots if axis == ROBOT else axis_of(studies.get(name), axis),
            )
            for axis in axes
        ),
    ]
    command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]  # typer reads it
    return command


def _run(
    name: str, axes: tuple[str, ...], *, output: Path, workers: int | None, **options: Any
) -> None:
    texts = {axis: options.pop(axis) for axis in axes if axis != ROBOT}
    chosen = {k: [v.strip() for v in text.split(",")] for k, text in texts.items() if text}
    with bar(f"study {name}") as show:

        def progress(done: int, trials: int, simulated: float, total: float) -> None:
            show(simulated, total, lambda x: f"{done} of {trials} trials  {x:.1f}x real time")

        rows = apnc.run_study(
            name,
            controllers=chosen.pop(CONTROLLERS_OPTION, None),
            chosen=chosen,
            workers=workers if workers is not None else os.cpu_count() or 1,
            output=writable(output),
            progress=progress,
            stop=STOP,
            **options,
        )
    ends = Counter(row["end"] for row in rows)
    counts = "".join(f", {count} {_ENDED.get(end, end)}" for end, count in sorted(ends.items()))
    say_file(f"{len(rows)} trials{counts}; report", output / "report.html")
    if few := without_verdict(name, rows, options["studies"]):
        say(few)
    if STOP.asked:
        raise Interrupted("interrupted; --resume finishes it")
    raise typer.Exit(TRIAL_FAILED if ends["error"] else 0)


def without_verdict(name: str, results: Sequence[Result], studies: Registry) -> str:
    """A line on controllers with too few seeds for a verdict on a claim; empty if none has."""
    from apnc.studies.study import load  # noqa: PLC0415  # takes long to import

    seeds: dict[tuple[str, str], set[int]] = {}
    for result in results:
        seeds.setdefault((result["study"], result["controller"]), set()).add(result["seed"])
    few = [
        controller
        for each in names_of(name, studies)
        for claim in load(studies[each]).claims
        for controller in claim.controllers
        if 0 < len(seeds.get((each, controller), ())) < claim.seeds
    ]
    if not few:
        return ""
    names = ", ".join(dict.fromkeys(few))
    return f"no verdict on claims about {names}: fewer than {MIN_SEEDS} seeds; raise --trials"


def about(entry: Entry) -> str:
    """Title of a study and where the paper has it, in one line."""
    return f"{entry.title} ({entry.section or 'not in the paper'})"


def _add(name: str, axes: tuple[str, ...], words: str) -> None:
    command = command_of(name, axes, STUDIES, folder=f"apnc-study-{name}")
    app.command(name, help=words, short_help=words)(command)


for _each in STUDIES.values():
    _add(_each.name, _each.options, about(_each))
_add(ALL, (CONTROLLERS_OPTION, ROBOT), "All of the paper's studies in one report")
