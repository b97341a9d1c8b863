"""Section 2.1.2: forward models: a copy of hip or knee command, or a radial basis network."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.report.figure import Figure
from apnc.studies.claims import NO, Claim, Judgement, Rule, both_criteria, verdict
from apnc.studies.plots import CRITERIA, side_by_side
from apnc.studies.results import (
    AUTHORS,
    SPEED,
    STRICT,
    Result,
    cells_in,
    matching,
    successes,
    values,
)
from apnc.studies.statistics import median, rate
from apnc.studies.study import Study
from apnc.studies.table import markdown, middle
from apnc_core.enumerations import ForwardModel
from research.command import main
from research.registry import STUDIES

MODELS: Final = {
    ForwardModel.low_pass_hip.name: "Eq. 10-11, hip",
    ForwardModel.low_pass_knee.name: "Eq. 10-11, knee",
    ForwardModel.radial_basis.name: "radial basis",
}
"""Names of the models in figures and tables."""

PRINTED, RADIAL = ForwardModel.low_pass_hip.name, ForwardModel.radial_basis.name

LAST: Final = 5.0
"""Time at the end of a walk over which its gain is averaged [s]."""

FORMING, LATE = "gain_forming", "gain_late"


def experiment(controller: str, seed: int, model: str, mi: float) -> Experiment:
    """A walk with a forward model."""
    settings = {"forward_model": ForwardModel[model]}
    return Experiment(controller=controller, seed=seed, mi=mi, duration=25.0, settings=settings)


def measure(record: Record) -> Result:
    """Gain of Eq. 9, mean over the legs, without the factor ``feedback_kept``.

    Returns:
        ``gain_forming``: mean until the couplings switch on [1].
        ``gain_late``: mean over the last 5 s [1].
        Both are None for a run that is not complete, or whose couplings switch on after the start
        of these 5 s or never.
    """
    gain = (record.signals["K_f"] + record.signals["K_s"]).mean(axis=1)
    on, begin = record.signals["kappa"] > 0.0, record.experiment.duration - LAST
    first = float(record.time[on.argmax()]) if on.any() else np.inf
    if not record.complete or first > begin or on[:1].any():
        return {FORMING: None, LATE: None}
    forming, late = record.time < first, record.time >= begin
    return {FORMING: float(gain[forming].mean()), LATE: float(gain[late].mean())}


def forms(model: str) -> Rule:
    """Rule: every trial with a model forms the gait. Nine of ten is partly."""

    def check(results: Sequence[Result], column: str) -> Judgement:
        hits = rate(successes(results, column, model=model))
        own, printed = (median(values(results, column, model=m)) for m in (model, PRINTED))
        text = f"{hits}, {own.text(1, 's')}, with the hip's {printed.text(1, 's')}"
        return Judgement(text, verdict(hits.value == 1.0, hits.value >= 0.9))

    return both_criteria(check)


def gain_falls(model: str) -> Rule:
    """Rule: the 95 % interval of the late gain over the forming one ends at 0.5 or below.

    Below 1 is partly.
    """

    def rule(results: Sequence[Result]) -> Judgement:
        both = [r for r in matching(results, model=model) if r.get(FORMING) and r.get(LATE)]
        forming, late = (median(values(both, column)) for column in (FORMING, LATE))
        ratio = median([result[LATE] / result[FORMING] for result in both])
        text = f"{forming.text(3)}, late {late.text(3)}, ratio {ratio.text(2)}, n = {ratio.size}"
        if not both:
            return Judgement(text, NO)
        return Judgement(text, verdict(ratio.high <= 0.5, ratio.high < 1.0))

    return rule


def figures(results: Sequence[Result]) -> list[Figure]:
    """Times, speed, and the gain while the gait forms and at the end, by model and MI."""
    cells = [(label, name, mi) for name, label in MODELS.items() for mi in cells_in(results, "mi")]

    def by_cell(column: str) -> dict[str, list[float]]:
        return {
            f"{label}, {mi:g}": values(results, column, model=m, mi=mi) for label, m, mi in cells
        }

    shown = (
        (STRICT, "Convergence, strict", CRITERIA[STRICT], "convergence time [s]"),
        (AUTHORS, "Convergence, authors'", CRITERIA[AUTHORS], "convergence time [s]"),
        (SPEED, "Speed", "along the path", "speed [m/s]"),
        (FORMING, "Gain until the couplings switch on", "K_f + K_s of Eq. 9", "gain"),
        (LATE, "Gain in the last 5 s", "K_f + K_s of Eq. 9", "gain"),
    )
    return [
        side_by_side(f"forward_model-{column}", title, f"By model and MI; {note}.", unit, found)
        for column, title, note, unit in shown
        if any((found := by_cell(column)).values())
    ]


def table(results: Sequence[Result]) -> str:
    """A line per model and MI, with medians, smallest and largest values."""
    return markdown(
        {
            "forward model": label,
            "MI": f"{mi:.2f}",
            "strict trot (95 % interval)": str(rate(successes(own))),
            "strict time [s]": middle(values(own, STRICT), 1),
            "authors' time [s]": middle(values(own, AUTHORS), 1),
            "speed [m/s]": middle(values(own, SPEED), 3),
            "gain until kappa = 1": middle(values(own, FORMING), 3),
            "gain in the last 5 s": middle(values(own, LATE), 3),
        }
        for model, label in MODELS.items()
        for mi in cells_in(results, "mi")
        if (own := matching(results, model=model, mi=mi))
    )


CLAIMS: Final = (
    Claim("2.1.2", "the knee's copy lets the load be expected",
          forms(ForwardModel.low_pass_knee.name)),
    Claim("2.1.2", "a radial basis function network can be the forward model", forms(RADIAL)),
    Claim("3.2.1, 4.3", "gamma becomes small once the gait has formed: radial basis, of itself",
          gain_falls(RADIAL)),
    Claim("3.2.1, 4.3", "gamma becomes small once the gait has formed: Eq. 10-11, of itself",
          gain_falls(PRINTED)),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["forward_model"],
    experiment,
    {"model": tuple(MODELS), "mi": (0.08, 0.15, 0.24)},
    controllers=("apnc",),
    measure=measure,
    claims=CLAIMS,
    figures=figures,
    table=table,
)

if __name__ == "__main__":
    main(STUDY.name)
