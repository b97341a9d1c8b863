"""What each departure from the paper buys: taken back alone, the walk is judged again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from apnc.loop.experiment import Experiment, Setting
from apnc.loop.record import Record
from apnc.studies.rows import Row, matching, successes, values
from apnc.studies.states.measure import measure as judged
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.study import Study
from apnc.studies.table import markdown, middle
from apnc_core.schema import Causality
from apnc_core.variables import rows as variables

TOGETHER: Final = (
    ("b1", "b2"), ("B_f", "B_s"), ("o1_start", "o2_start"), ("xi",), ("feedback_kept",),
    ("phase_measure",), ("phase_filter",), ("kappa_rule",), ("coupling_sign",), ("phi_frozen",),
    ("MI_zero_resets",),
)  # fmt: skip
"""Parameters that differ from the paper or the authors' code, those that belong together in one."""

PRINTED: Final[Mapping[str, Setting]] = {
    v.name: v.paper
    for v in variables(Causality.parameter)
    if v.paper is not None and v.paper != v.start
}

NONE: Final = "none"

REMOVED: Final[Mapping[str, Mapping[str, Setting]]] = {
    NONE: {},
    **{
        ", ".join(own): {name: PRINTED[name] for name in own}
        for names in TOGETHER
        if (own := [name for name in names if name in PRINTED])
    },
}
"""Parameters as printed, by the departure that is taken back."""

WALKS: Final = {"MI 0.08": 0.08, "MI 0.15": 0.15, "MI 0.28": 0.28}
STATES: Final = "S1 to S3"
WALK_S: Final = 25.0
"""Length of the walks [s]."""


def experiment(method: str, seed: int, removed: str, task: str) -> Experiment:
    """A walk, or the run through the states S1 to S3, without one departure."""
    if task == STATES:
        return TIMELINE.experiment(method, seed, settings=REMOVED[removed])
    walk = {"method": method, "seed": seed, "settings": REMOVED[removed]}
    return Experiment(mi=WALKS[task], duration=WALK_S, **walk)  # type: ignore[arg-type]  # by name


def measure(record: Record) -> Row:
    """What became of the gait in S1 to S3, for the run through them."""
    return judged(record) if isinstance(record.experiment.mi, tuple) else {}


def table(rows: Sequence[Row]) -> str:
    """A line per departure: runs that form the strict trot, a speed, runs through S1 to S3."""
    return markdown(_line(removed, matching(rows, removed=removed)) for removed in _in_order(rows))


def _in_order(rows: Sequence[Row]) -> list[str]:
    return list(dict.fromkeys(row["removed"] for row in rows))


def _line(removed: str, rows: Sequence[Row]) -> dict[str, str]:
    names = REMOVED[removed]
    entries = {"as printed": ", ".join(f"{n} = {_text(v)}" for n, v in names.items()) or NONE}
    for task in WALKS:
        hits = successes(matching(rows, task=task))
        entries[f"trot, {task}"] = f"{sum(hits)}/{len(hits)}"
    speeds = values(matching(rows, task="MI 0.15"), "late_speed_m_per_s")
    entries["speed at MI 0.15 [m/s]"] = middle(speeds, 3)
    runs = matching(rows, task=STATES)
    for state in ("S1", "S2", "S3"):
        entries[state] = f"{sum(bool(run.get(f'state_{state}')) for run in runs)}/{len(runs)}"
    return entries


def _text(value: Setting) -> str:
    return str(getattr(value, "name", value))


STUDY: Final = Study(
    "departures",
    experiment,
    {"removed": tuple(REMOVED), "task": (*WALKS, STATES)},
    methods=("apnc",),
    measure=measure,
    table=table,
)
