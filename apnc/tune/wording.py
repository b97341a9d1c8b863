"""What was found, in words: verdicts of the report, and tables of report and command line."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from apnc.report.wording import Verdict
from apnc.tune.aims import AIM_ALONE
from apnc.tune.runs import MARGIN
from apnc.tune.tuned_file import changes
from apnc.tune.tuning import Tuned
from apnc.tune.validation import AIMS, Cell, Validation, in_words, percent
from apnc_core.variables import variable_named

COLUMNS: Final = (
    "MI", "with ANC", "APC alone", f"body off by {percent(MARGIN)}", "after [s]", "m/s",
    "lift [mm]", "slip [%]",
)  # fmt: skip
"""Headings of the table of a validation."""

OTHERS: Final = (
    ("payload", "payload of a fifth of its mass"),
    ("sensor", "one foot sensor dead"),
    ("air", "let down from the air"),
)
"""Kinds of runs at one MI, in words."""

FAIR: Final = 0.5
"""Share of good walks from which on a verdict is fair [1]."""

_UNITS: Final = {
    "rate": "Hz",
    "femur_angle": "deg",
    "tibia_angle": "deg",
    "mass": "kg",
    "com": "m",
    "servo.stiffness": "N m/rad",
    "servo.damping": "N m s/rad",
    "servo.reflected_inertia": "kg m^2",
    "contact.stiffness": "N/m",
    "contact.damping": "N s/m",
}
"""Units of the keys of a robot file that a search changes; those without are 1."""


def lines_to_paste(output: Path) -> tuple[tuple[str, str], ...]:
    """What to do with a tuned robot, and the command that does it."""
    name = shlex.quote(str(output))
    return (
        ("walk it", f"apnc walk --robot {name} --engine compiled"),
        ("study it", f"apnc study mi --robot {name} --trials 3"),
        ("build its FMU", f"apnc build --robot {name}"),
    )


def table(found: Validation) -> list[tuple[str, ...]]:
    """Rows of the table of a validation, one for each MI, see ``COLUMNS``."""
    kinds = ("walk", "apc", "varied")
    cells = zip(*map(found.of, kinds), strict=True)
    return [
        (
            f"{walk.mi:.3g}",
            *(str(cell.good) for cell in (walk, alone, varied)),
            f"{walk.time * found.time:.1f}" if walk.strict else "–",
            *_medians(walk, found),
        )
        for walk, alone, varied in cells
    ]


def _medians(walk: Cell, found: Validation) -> tuple[str, str, str]:
    """Speed, lift and slip; where most robots fell there is nothing to measure."""
    if walk.middle("fell") < 1.0:
        return "fell", "–", "–"
    return (
        f"{walk.middle('speed') * found.speed:.3f}",
        f"{1e3 * walk.middle('lift') * found.length:.1f}",
        f"{100.0 * walk.middle('slip'):.0f}",
    )


def others(found: Validation) -> list[str]:
    """What the robot does in other conditions, in lines."""
    return [
        f"{words}, MI {cell.mi:.3g}: {cell.good} of {len(cell.runs)}"
        for kind, words in OTHERS
        for cell in found.of(kind)
    ]


def verdicts(tuned: Tuned) -> list[Verdict]:
    """What was found, how much margin there is, and what was not reached."""
    found = tuned.validation
    if found is None:
        return [_found_in_search(tuned)]
    return [_found(found), _margin(found), _missed(found)]


def changed(tuned: Tuned) -> list[tuple[str, str, str, str]]:
    """Key, old value, new value and unit of what the search changed."""
    return [
        (".".join(place), _told(old), _told(new), _unit(place))
        for place, old, new in changes(tuned.before, tuned.robot)
        if old != new
    ]


def _found(found: Validation) -> Verdict:
    walks, alone = found.of("walk"), found.of("apc")
    whole = sum(cell.good == len(cell.runs) for cell in walks)
    good, of = _good(found, "walk")
    by_itself, of_alone = _good(found, "apc")
    detail = (
        f"{good} of {of} walks with ANC, of seeds that the search has not seen; "
        f"{by_itself} of {of_alone} with APC alone"
    )
    if speeds := [cell.middle("speed") * found.speed for cell in walks if cell.good]:
        detail += f"; {_span(speeds, 3)} m/s"
    answer = f"{found.gait.capitalize()} at {whole} of {len(walks)} MI"
    if not good and not sum(cell.good for cell in alone):
        answer = f"No {found.gait} that walks"
    mood = "good" if whole == len(walks) else "fair" if good >= FAIR * of else "bad"
    return Verdict("What was found?", answer, detail, mood)


def _found_in_search(tuned: Tuned) -> Verdict:
    answer, _, rest = in_words(tuned.best).partition(", ")
    good, alone = (
        sum(run.good for run in tuned.best.runs if run.kind == kind) for kind in ("walk", "apc")
    )
    more = f"{rest}, " if rest else ""
    detail = (
        f"{more}with APC alone at {alone}; one walk each. Interrupted before it walked with seeds "
        "of its own."
    )
    return Verdict(
        "What was found?", f"{answer[:1].upper()}{answer[1:]}", detail, "fair" if good else "bad"
    )


def _margin(found: Validation) -> Verdict:
    good, of = _good(found, "varied")
    more = "; ".join(
        f"{words} {good_one} of {of_one}"
        for kind, words in OTHERS
        for good_one, of_one in [_good(found, kind)]
    )
    detail = f"walk with every number of the body off by up to {percent(MARGIN)}; {more}"
    detail = detail.replace(" %", "\N{NO-BREAK SPACE}%")
    return Verdict("How much margin?", f"{good} of {of}", detail, _mood(good, of))


def _missed(found: Validation) -> Verdict:
    question, missed = "What was not reached?", found.missed()
    if not missed:
        return Verdict(question, "Nothing", "all aims were reached", "good")
    places = ", ".join(f"{each.aim} at {each.places} MI" for each in missed)
    answer = f"{len(missed)} of {AIMS} aims"
    return Verdict(question, answer, places.replace(" %", "\N{NO-BREAK SPACE}%"), "fair")


def _good(found: Validation, kind: str) -> tuple[int, int]:
    cells = found.of(kind)
    return sum(cell.good for cell in cells), sum(len(cell.runs) for cell in cells)


def _mood(good: int, of: int) -> str:
    return "good" if good >= AIM_ALONE * of else "fair" if good >= FAIR * of else "bad"


def _span(values: Sequence[float], digits: int) -> str:
    low, high = (f"{value:.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def _told(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, list | tuple):
        return ", ".join(map(_told, value))
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _unit(place: Sequence[str]) -> str:
    if place[0] == "controller":
        return variable_named(place[-1]).unit or "1"
    return _UNITS.get(".".join(place[-2:]), _UNITS.get(place[-1], "1"))
