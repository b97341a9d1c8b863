"""Section 3.2: a gait forms (S1), sensors break (S2), and memory brings it back (S3)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from apnc.studies.claims import Claim, Finding, Rule, verdict
from apnc.studies.rows import Row, matching, values
from apnc.studies.states.figures import COUPLINGS, STATES, figures, scenes
from apnc.studies.states.measure import measure
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.statistics import median, rate
from apnc.studies.study import Study
from apnc.studies.table import markdown, middle

FORMED, BACK = ("state_formation_time_s", "formed"), ("state_recovery_time_s", "back")

MEANING: Final = {
    "apnc": ("the gait forms and lasts to the break",
             "keeps the gait at every moment and walks, front sensors stuck",
             "recovers the stored gait from rest without feedback, and walks"),
    "apc": ("the gait forms and lasts to the break",
            "front oscillators stop",
            "rocks in place, legs in phase"),
}  # fmt: skip


def state(name: str, method: str, when: tuple[str, str] | None = None) -> Rule:
    """A state went as the paper says in every run of a method; half of them are 'partly'.

    Args:
        name: S1, S2 or S3.
        method: with (apnc) or without the couplings.
        when: what else is told: a column in seconds, and its word.
    """

    def rule(rows: Sequence[Row]) -> Finding:
        runs = matching(rows, method=method)
        hits = rate([bool(row.get(f"state_{name}")) for row in runs])
        text = f"{hits}, speed {median(values(runs, f'state_speed_{name.lower()}')).text(3, 'm/s')}"
        if when:
            text += f", {when[1]} after {median(values(runs, when[0])).text(1, 's')}"
        return Finding(text, verdict(hits.value == 1.0, hits.value >= 0.5))

    return rule


def table(rows: Sequence[Row]) -> str:
    """Success per state with its exact 95 % interval, times and speeds."""
    return markdown(
        {
            "couplings": COUPLINGS[method],
            "state": name,
            "as the paper says": meaning,
            "success (95 % interval)": str(rate([bool(run.get(f"state_{name}")) for run in runs])),
            "time [s], median (range)": middle(values(runs, time), 1),
            "speed [m/s], median (range)": middle(values(runs, f"state_speed_{name.lower()}"), 3),
        }
        for method, meanings in MEANING.items()
        if (runs := matching(rows, method=method))
        for name, meaning, time in zip(STATES, meanings, (FORMED[0], "", BACK[0]), strict=True)
    )


CLAIMS: Final = (
    Claim("3.2.1, Fig. 10", "S1: set down at 1.7 s, the trot forms", state("S1", "apnc", FORMED)),
    Claim("3.2.2, Fig. 11B", "S2: with ANC it trots on with both front sensors stuck",
          state("S2", "apnc")),
    Claim("3.2.2, Fig. 11A", "S2: without ANC the front oscillators stop",
          state("S2", "apc"), ("apc",)),
    Claim("3.2.3, Fig. 12B", "S3: with ANC the gait comes back without feedback",
          state("S3", "apnc", BACK)),
    Claim("3.2.3, Fig. 12A", "S3: without ANC the robot stays on the spot, legs in phase",
          state("S3", "apc"), ("apc",)),
)  # fmt: skip

STUDY: Final = Study(
    "states",
    TIMELINE.experiment,
    methods=tuple(COUPLINGS),
    measure=measure,
    claims=CLAIMS,
    figures=figures,
    scenes=scenes,
    table=table,
)
