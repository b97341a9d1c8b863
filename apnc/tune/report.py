"""The report of a tuned robot: one HTML file."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

from apnc.features import walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.loop.simulate import simulate
from apnc.report.animation import animation_data
from apnc.report.encoding import Signal
from apnc.report.figure import Figure
from apnc.report.figures import gait, phases
from apnc.report.html import page
from apnc.report.lines import Run
from apnc.report.page import drawable
from apnc.report.theme import leg_colours
from apnc.tune import figures
from apnc.tune.log import read_rows
from apnc.tune.tuning import Tuned
from apnc.tune.validation import with_article
from apnc.tune.wording import COLUMNS, changed, lines_to_paste, others, table, verdicts
from apnc_core import __version__
from apnc_plant.robot.size import mean_leg_length
from build_fmu.writing import write_atomically

FILM_S: Final = 20.0
"""Length of the film [s]."""

FILM_TICKS: Final = 2400
"""Most ticks of a film; at a high rate it is shorter, so that the page stays small."""


def write_report(path: Path, tuned: Tuned, output: Path) -> None:
    """Write the page of a tuned robot.

    Args:
        path: of the page.
        tuned: the tuned robot.
        output: its robot file, whose log is beside it.
    """
    write_atomically(path, render(tuned, output).encode("utf-8"))


def render(tuned: Tuned, output: Path) -> str:
    """HTML text of the page, however the search ended."""
    record = film(tuned)
    shown = drawable(record)
    run = Run(shown, walk_features(record)) if len(shown) else None
    found, log = tuned.validation, output.with_suffix(".csv")
    over_mi: list[Figure] = [figures.formed(found), figures.walked(found)] if found else []
    over_time = [gait(run), phases(run)] if run else []
    of_search = [figures.progress(read_rows(log))] if log.exists() else []
    return page(
        "tuned.html.j2",
        [*over_mi, *over_time, *of_search],
        package="apnc.tune",
        scripts=("scene.js", "stage.js", "animation.js") if run else (),
        data=_data(run) if run else {},
        over_mi=over_mi,
        over_time=over_time,
        of_search=of_search,
        name=tuned.robot.name,
        about=_about(tuned),
        verdicts=verdicts(tuned),
        colours=leg_colours(record.legs),
        film=run is not None,
        film_words=_film_words(record),
        notes=_notes(tuned, record),
        columns=COLUMNS,
        rows=table(found) if found else [],
        seeds=len(found.of("walk")[0].runs) if found else 0,
        gait=with_article(found.gait) if found else "",
        others=others(found) if found else [],
        missed=[each.words for each in found.missed()] if found else [],
        changed=changed(tuned),
        lines=lines_to_paste(output),
        command=tuned.command,
        log=log.name,
    )


def film(tuned: Tuned) -> Record:
    """The walk that the page shows: that of ``apnc walk`` at the MI of the robot's file."""
    robot = tuned.robot
    experiment = Experiment(robot=robot, engine="compiled")
    seconds = min(FILM_S, FILM_TICKS / experiment.rate)
    return simulate(Experiment(robot=robot, engine="compiled", duration=seconds))


def _data(run: Run) -> dict[str, Any]:
    return {
        "time": Signal(run.record.time[run.samples.at], exact=True),
        "opensAt": None,
        "animation": animation_data(run),
    }


def _about(tuned: Tuned) -> str:
    robot, count = tuned.robot, tuned.count
    low, high = robot.mi_range or (0.0, 0.0)
    words = [
        f"{robot.mass:.3g} kg, legs of {1e3 * mean_leg_length(robot):.0f} mm",
        f"MI {low:.3g} to {high:.3g}",
        f"{count.candidates} candidates in {count.wall / 60.0:.1f} min",
        f"apnc {__version__}",
    ]
    return " · ".join(words)


def _film_words(record: Record) -> str:
    return f"MI {record.experiment.mi:.3g}, seed {record.experiment.seed}"


def _notes(tuned: Tuned, record: Record) -> list[str]:
    notes = []
    if tuned.validation is None:
        notes.append(
            "The search was interrupted. --resume goes on with it, and then the robot walks with "
            "seeds that the search has not seen."
        )
    if not record.complete:
        notes.append(
            f"The robot {record.end} after {record.ended_at:.2f} s of the walk shown here."
        )
    return notes
