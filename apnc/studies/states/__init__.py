"""Section 3.2: a gait forms (S1), sensors break (S2), and memory brings it back (S3)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from apnc.controllers import BASELINES, distinct, named_controller
from apnc.studies.claims import FEW, Claim, Judgement, Rule, of_decided, verdict
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import Result, controllers_in, gait_in, is_number, matching, values
from apnc.studies.states.figures import COUPLINGS, STATES, figures, scenes
from apnc.studies.states.measure import measure
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.statistics import median, rate
from apnc.studies.study import Study, fewer_of_others
from apnc.studies.table import markdown, middle

COMPARED: Final = distinct(BASELINES, "states")

FORMED, BACK = ("state_formation_time_s", "formed"), ("state_recovery_time_s", "back")

GAMMA: Final = ("state_gamma_before", "state_gamma_after")

MEANING: Final = {
    "apnc": ("the gait forms and lasts to the break",
             "keeps the gait at every moment and walks, front sensors stuck",
             "recovers the stored gait from rest without feedback, and walks"),
    "apc": ("the gait forms and lasts to the break",
            "front oscillators stop",
            "rocks in place, legs in phase"),
}  # fmt: skip
WITH_GAIT: Final = ("forms", "keeps the {gait} and walks", "comes back to the {gait} and walks")
"""Meaning of the states for all other controllers. The paper has no figure of them."""


def state(name: str, controller: str, when: tuple[str, str] | None = None) -> Rule:
    """Rule: a state went as the paper says in every run of a controller. Half of them is partly.

    Args:
        name: S1, S2 or S3.
        controller: label: apnc with the couplings, apc without.
        when: column with a time [s] to add to the text, and the word before it.
    """

    def rule(results: Sequence[Result]) -> Judgement:
        runs = matching(results, controller=controller)
        hits = rate([bool(result.get(f"state_{name}")) for result in runs])
        speed = median(values(runs, f"state_speed_{name.lower()}"))
        text = f"{hits}, speed {speed.text(3, 'm/s', len(runs))}"
        if when:
            text += f", {when[1]} after {median(values(runs, when[0])).text(1, 's', len(runs))}"
        return Judgement(text, verdict(hits.value == 1.0, hits.value >= 0.5))

    return rule


def without_gait(name: str) -> Rule:
    """Rule: no run of a baseline has the gait in a state, at any setting.

    Less than half of the runs is partly. In S2 only runs count that had the gait at the break.
    """

    def rule(results: Sequence[Result]) -> Judgement:
        def of(label: str) -> Judgement:
            runs = matching(results, controller=label)
            runs = matching(runs, state_S1=True) if name == "S2" else runs
            hits = rate([bool(result.get(f"state_{name}")) for result in runs])
            speed = median(values(runs, f"state_speed_{name.lower()}"))
            text = f"{gait_in(results)} in {hits}, speed {speed.text(3, 'm/s', len(runs))}"
            if hits.trials == 0:
                return Judgement(f"no run had the {gait_in(results)} before", FEW)
            if hits.trials < MIN_SEEDS:
                return Judgement(text, FEW)
            return Judgement(text, verdict(hits.successes == 0, hits.value < 0.5))

        found = [of(label) for label in COMPARED]
        texts = (
            f"{named_controller(m).name}: {f.measured}"
            for m, f in zip(COMPARED, found, strict=True)
        )
        return Judgement("; ".join(texts), of_decided([f.verdict for f in found]))

    return rule


def gamma_by_itself(results: Sequence[Result]) -> Judgement:
    """With all feedback kept, the median of gamma falls to half or less once the couplings are on.

    A fall to four fifths is partly. APNC keeps less feedback, so its gamma falls by construction
    and does not count.
    """
    texts, ratios = [], []
    for label in ("apnc", "apnc_kept"):
        runs = [
            result
            for result in matching(results, controller=label)
            if is_number(result.get(GAMMA[1]))
        ]
        before, after = (median(values(runs, column)).value for column in GAMMA)
        ratios = [result[GAMMA[1]] / result[GAMMA[0]] for result in runs if result[GAMMA[0]] > 0.0]
        fall = f"{before:.3f} to {after:.3f}" if runs else "-"
        texts.append(f"{named_controller(label).name}: {fall}, n = {len(runs)}")
    text = f"imposed in APNC by feedback_kept; {'; '.join(texts)}"
    if len(ratios) < MIN_SEEDS:
        return Judgement(text, FEW)
    ratio = median(ratios)
    return Judgement(
        f"{text}, ratio {ratio.text(2)}", verdict(ratio.value <= 0.5, ratio.value <= 0.8)
    )


def table(results: Sequence[Result]) -> str:
    """Success per state with its exact 95 % interval, times and speeds."""
    return markdown(
        {
            "couplings": COUPLINGS.get(controller, named_controller(controller).name),
            "state": name,
            "as the paper says": meaning.format(gait=gait_in(results)),
            "success (95 % interval)": str(rate([bool(run.get(f"state_{name}")) for run in runs])),
            "time [s], median (range)": middle(values(runs, time), 1),
            "speed [m/s], median (range)": middle(values(runs, f"state_speed_{name.lower()}"), 3),
        }
        for controller in controllers_in(results)
        for runs, meanings in [
            (matching(results, controller=controller), MEANING.get(controller, WITH_GAIT))
        ]
        for name, meaning, time in zip(STATES, meanings, (FORMED[0], "", BACK[0]), strict=True)
    )


CLAIMS: Final = (
    Claim("3.2.1, Fig. 10", "S1: set down at 1.7 s, the {gait} forms", state("S1", "apnc", FORMED)),
    Claim("3.2.2, Fig. 11B", "S2: with ANC the {gait} goes on with both front sensors stuck",
          state("S2", "apnc")),
    Claim("3.2.2, Fig. 11A", "S2: without ANC the front oscillators stop",
          state("S2", "apc"), ("apc",)),
    Claim("3.2.3, Fig. 12B", "S3: with ANC the gait comes back without feedback",
          state("S3", "apnc", BACK)),
    Claim("3.2.3, Fig. 12A", "S3: without ANC the robot stays on the spot, legs in phase",
          state("S3", "apc"), ("apc",)),
    Claim("3.1.4, note 5", "with broken feedback Tegotae and phase resetting lose the gait (S2)",
          without_gait("S2"), COMPARED),
    Claim("3.1.4, note 5", "Tegotae and phase resetting store no gait and do not recover it (S3)",
          without_gait("S3"), COMPARED),
    Claim("3.2.1", "once the couplings are on the feedback gain gamma becomes small by itself",
          gamma_by_itself, ("apnc", "apnc_kept")),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["states"],
    TIMELINE.experiment,
    controllers=(*COUPLINGS, *COMPARED, "apnc_kept"),
    seeds=fewer_of_others(),
    measure=measure,
    claims=CLAIMS,
    figures=figures,
    scenes=scenes,
    table=table,
)
