"""What does each departure from the paper buy? Each is taken back alone, and the walk is judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies.results import Result, matching, successes, values
from apnc.studies.states.measure import STOPPED
from apnc.studies.states.measure import measure as judged
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.study import SCHEDULE_MI, WALK_MI, Study
from apnc.studies.table import markdown, middle
from apnc_core.schema import Causality
from apnc_core.settings import SettingLike
from apnc_core.variables import variables_of as variables
from research.command import main
from research.registry import STUDIES

TOGETHER: Final = (
    ("a2",), ("b1", "b2"), ("B_f", "B_s"), ("o1_start", "o2_start"), ("xi",), ("feedback_kept",),
    ("phase_measure",), ("phase_filter",), ("kappa_rule",), ("coupling_sign",), ("phi_frozen",),
    ("MI_zero_resets",),
)  # fmt: skip
"""Parameters that differ from the paper or the authors' code, in groups that belong together."""

PRINTED: Final[Mapping[str, SettingLike]] = {
    v.name: v.paper
    for v in variables(Causality.parameter)
    if v.paper is not None and v.paper != v.start
}

NONE: Final = "none"

REMOVED: Final[Mapping[str, Mapping[str, SettingLike]]] = {
    NONE: {},
    **{
        ", ".join(own): {name: PRINTED[name] for name in own}
        for names in TOGETHER
        if (own := [name for name in names if name in PRINTED])
    },
}
"""Parameters as printed, by the departure that is taken back."""

WALKS: Final[Mapping[str, Mapping[str, Any]]] = {
    "MI 0.08": {"mi": 0.08},
    "MI 0.15": {"mi": 0.15},
    "MI 0.28": {"mi": 0.28},
    "C4": {"mi": WALK_MI, "conditions": "C4"},
    "C3": {"mi": SCHEDULE_MI, "conditions": "C3"},
}
"""Fields of the experiment by name of the walk."""

STATES: Final = "S1 to S3"
STOP_MOVES: Final = "moves_at_mi_zero"
WALK_S: Final = 25.0
"""Length of the walks [s]."""


def experiment(controller: str, seed: int, removed: str, task: str) -> Experiment:
    """A walk, or the run through the states S1 to S3, with one departure taken back."""
    if task == STATES:
        return TIMELINE.experiment(controller, seed, settings=REMOVED[removed])
    walk: dict[str, Any] = {"controller": controller, "seed": seed, "settings": REMOVED[removed]}
    return Experiment(duration=WALK_S, **walk, **WALKS[task])


def measure(record: Record) -> Result:
    """Figures of the states S1 to S3, for the run through them.

    Returns:
        The figures of the study ``states``, and ``moves_at_mi_zero``: whether an oscillator moves
        in the last second of MI = 0. Nothing for a walk.
    """
    if not isinstance(record.experiment.mi, tuple):
        return {}
    time, o1 = record.time, record.signals["o1"]
    late = o1[(time >= TIMELINE.restarted - 1.0) & (time < TIMELINE.restarted)]
    moves = bool((np.ptp(late, axis=0) >= STOPPED).any()) if len(late) else None
    return judged(record) | {STOP_MOVES: moves}


def table(results: Sequence[Result]) -> str:
    """A line per departure: runs that form the strict trot, speed, and runs through S1 to S3."""
    return markdown(
        _line(removed, matching(results, removed=removed)) for removed in _in_order(results)
    )


def _in_order(results: Sequence[Result]) -> list[str]:
    return list(dict.fromkeys(result["removed"] for result in results))


def _line(removed: str, results: Sequence[Result]) -> dict[str, str]:
    names = REMOVED[removed]
    entries = {"as printed": ", ".join(f"{n} = {_text(v)}" for n, v in names.items()) or NONE}
    for task in WALKS:
        hits = successes(matching(results, task=task))
        entries[f"trot, {task}"] = f"{sum(hits)}/{len(hits)}"
    speeds = values(matching(results, task="MI 0.15"), "late_speed_m_per_s")
    entries["speed at MI 0.15 [m/s]"] = middle(speeds, 3)
    runs = matching(results, task=STATES)
    for state in ("S1", "S2", "S3"):
        entries[state] = f"{sum(bool(run.get(f'state_{state}')) for run in runs)}/{len(runs)}"
    stops = [run.get(STOP_MOVES) is False for run in runs]
    entries["stops at MI = 0"] = f"{sum(stops)}/{len(stops)}"
    return entries


def _text(value: SettingLike) -> str:
    return str(getattr(value, "name", value))


STUDY: Final = Study(
    STUDIES["departures"],
    experiment,
    {"removed": tuple(REMOVED), "task": (*WALKS, STATES)},
    controllers=("apnc",),
    measure=measure,
    table=table,
)

if __name__ == "__main__":
    main(STUDY.name)
