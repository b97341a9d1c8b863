"""Section 4.1: how strong should the feedback be? It is varied from too weak to too strong.

The study also finds the best setting of each baseline, see ``best_setting``. The settings that it
found are in ``apnc.controllers``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np

from apnc.controllers import CONTROLLERS, named_controller
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.report.figure import Figure
from apnc.studies.claims import (
    FEW,
    SIGNIFICANT,
    Claim,
    Judgement,
    both_criteria,
    each_of,
    verdict,
)
from apnc.studies.plots import convergence
from apnc.studies.registry import MIN_SEEDS, STUDIES
from apnc.studies.results import (
    AUTHORS,
    STRICT,
    Result,
    cells_in,
    is_number,
    matching,
    successes,
    values,
)
from apnc.studies.states.measure import STOPPED, WALKS
from apnc.studies.statistics import compare, median, p_text, rate
from apnc.studies.study import WALK_MI, WALK_S, Study
from apnc.studies.table import markdown, middle
from apnc_core.variables import variable_named

GAINS: Final[Mapping[str, tuple[float, ...]]] = {
    "tegotae": (0.015, 0.03, 0.06, 0.09, 0.12, 0.15, 0.2, 0.3, 0.45),
    "phase_reset": (0.1, 0.2, 0.4, 0.6, 0.8, 1.2, 1.6),
    "apnc": (0.01, 0.1, 0.3, 1.0, 3.0, 10.0),
    "apnc_printed": (1.0,),
}
"""Values by controller: gain of Tegotae, threshold of the phase reset, factor on rates of APNC.

Learning rates are limited to 1. ``apnc_printed`` has the printed rates, so its factor is 1.
"""

PARAMETERS: Final = {"tegotae": "gamma_tegotae", "phase_reset": "grf_reset"}
"""Parameter that is varied, by baseline."""

TITLES: Final = {
    "tegotae": "gain of Tegotae [1]",
    "phase_reset": "threshold of the phase reset over a quarter of the weight [1]",
    "apnc": "factor on the learning rates of APNC [1]",
}

RATES: Final = ("B_f", "B_s")
LATE_SPEED, STILL = "late_speed_m_per_s", "stopped_oscillators"

LAST: Final = 3.0
"""Time at the end of a walk in which an oscillator must move, otherwise it has stopped [s]."""


def experiment(controller: str, seed: int, mi: float, gain: float) -> Experiment:
    """A walk at a gain. A factor of 1 leaves the learning rates as they are."""
    walk = Experiment(controller=controller, seed=seed, mi=mi, duration=WALK_S)
    method = named_controller(controller).method
    if method in PARAMETERS:
        return replace(walk, settings={PARAMETERS[method]: gain})
    if gain == 1.0:
        return walk
    own = walk.parameters()
    return replace(walk, settings={name: _scaled(name, own[name], gain) for name in RATES})


def _scaled(name: str, value: Any, factor: float) -> float:
    limit = variable_named(name).max
    assert limit is not None
    return min(factor * float(value), limit)


def seeds(cell: Mapping[str, Any], trials: int) -> int:
    """A quarter of the seeds at the gains of the controller, none at other gains."""
    return -(-trials // 4) if cell["gain"] in GAINS[cell["controller"]] else 0


def measure(record: Record) -> Result:
    """Number of oscillators that do not move at the end. None for a run without that part."""
    late = record.signals["o1"][record.time >= record.ended_at - LAST]
    if len(late) == 0:
        return {STILL: None}
    return {STILL: int((np.ptp(late, axis=0) < STOPPED).sum())}


def best_setting(results: Sequence[Result]) -> float | None:
    """The gain with the most walks in the strict gait.

    A walk counts if the gait formed by the criterion, the robot did not fall, and its speed at the
    end is at least ``WALKS``. Gains with as many walks are ordered by the number of walks by the
    authors' criterion, then by the median of the authors' time, where a run without one counts as
    infinite, then by size.

    Args:
        results: results of one controller, with the same number of runs at every gain.

    Returns:
        The gain. None without results, or if no run counts by either criterion.
    """

    def merit(gain: float) -> tuple[int, int, float, float]:
        own = matching(results, gain=gain)
        times = [result[AUTHORS] if is_number(result.get(AUTHORS)) else np.inf for result in own]
        return -walks(own), -walks(own, AUTHORS), float(np.median(times)), gain

    best: float | None = min(cells_in(results, "gain"), key=merit, default=None)
    return best if best is not None and merit(best)[:2] != (0, 0) else None


def walks(results: Sequence[Result], criterion: str = STRICT) -> int:
    """Number of runs whose gait formed by a criterion and that walk at the end."""
    fast = (is_number(result.get(LATE_SPEED)) and result[LATE_SPEED] >= WALKS for result in results)
    return sum(a and b for a, b in zip(successes(results, criterion), fast, strict=True))


def _reference(results: Sequence[Result], label: str) -> float | None:
    """Gain to compare others with: the best of a baseline, the shipped one of APNC."""
    return best_setting(results) if label in PARAMETERS else 1.0


def too_strong(results: Sequence[Result]) -> Judgement:
    """Whether oscillators stop at the strongest gain and none does at the best gain.

    Reproduced if one stops in half of the runs at the strongest gain, partly if in some.
    """

    def of(label: str) -> Judgement:
        own = matching(results, controller=label)
        good, most = _reference(own, label), max(cells_in(own, "gain"))
        at_best, at_most = (
            rate([number > 0 for number in values(own, STILL, gain=gain)]) for gain in (good, most)
        )
        text = f"stopped in {at_most} at {most:g}, in {at_best} at {_text(good)}"
        if good in (None, most) or min(at_best.trials, at_most.trials) < MIN_SEEDS:
            return Judgement(text, FEW)
        none = at_best.successes == 0
        return Judgement(text, verdict(none and at_most.value >= 0.5, none and at_most.value > 0))

    return each_of(("tegotae", "apnc"), of)


def too_weak(results: Sequence[Result], column: str) -> Judgement:
    """Whether the gait forms significantly later at the weakest gain than at the best.

    A run in which it never forms counts with its duration.
    """

    def of(label: str) -> Judgement:
        own = matching(results, controller=label)
        good, least = _reference(own, label), min(cells_in(own, "gain"))
        weak, best = (matching(own, gain=gain) for gain in (least, good))
        times = [[r.get(column) or r["duration"] for r in part] for part in (weak, best)]
        test = compare(*times)
        shown = (median(values(part, column)).text(1, "s", len(part)) for part in (weak, best))
        text = f"{next(shown)} at {least:g}, {next(shown)} at {_text(good)}, {p_text(test.p)}"
        if good in (None, least) or min(len(part) for part in times) < MIN_SEEDS:
            return Judgement(text, FEW)
        return Judgement(text, verdict(test.effect > 0 and test.p <= SIGNIFICANT, False))

    return each_of(("tegotae", "apnc"), of)


def _text(gain: float | None) -> str:
    return "-" if gain is None else f"{gain:g}"


def table(results: Sequence[Result]) -> str:
    """A line per controller and gain. The best of a baseline is marked."""
    lines = []
    for label in (label for label in GAINS if matching(results, controller=label)):
        own = matching(results, controller=label)
        best = best_setting(own) if label in PARAMETERS else None
        lines += [_line(label, gain, own, gain == best) for gain in cells_in(own, "gain")]
    return markdown(lines)


def _line(label: str, gain: float, results: Sequence[Result], best: bool) -> dict[str, str]:
    own = matching(results, gain=gain)
    used = _reference(results, label) if label == "apnc" else None
    names = [PARAMETERS[label]] if label in PARAMETERS else []
    for known in CONTROLLERS.values() if names else ():
        used = gain if known.settings.get(names[0]) == gain else used
    marks = ["best"] * best + ["used"] * (used == gain)
    return {
        "what": TITLES.get(label, named_controller(label).name),
        "value": f"{gain:g}",
        "": ", ".join(marks),
        "walks in the strict trot": f"{walks(own)}/{len(own)}",
        "strict": str(rate(successes(own))),
        "authors' criterion": str(rate(successes(own, AUTHORS))),
        "authors' time [s]": middle(values(own, AUTHORS), 1),
        "speed [m/s]": middle(values(own, LATE_SPEED), 3),
        "runs with a stopped oscillator": str(sum(n > 0 for n in values(own, STILL))),
        "fell": str(len(matching(own, fell=True))),
    }


def figures(results: Sequence[Result]) -> list[Figure]:
    """Times and success over the gain, a figure per controller and criterion."""
    found = []
    for label, title in TITLES.items():
        own = [
            result for result in results if named_controller(result["controller"]).method == label
        ]
        found += [
            replace(figure, key=figure.key.replace("gains", f"gains-{label}", 1))
            for figure in (convergence(own, ("gain", title)) if own else [])
        ]
    return found


CLAIMS: Final = (
    Claim("4.1", "too strong an inhibition stops the oscillators",
          too_strong, ("tegotae", "apnc")),
    Claim("4.1", "with too weak an inhibition the gait forms very slowly",
          both_criteria(too_weak), ("tegotae", "apnc")),
)  # fmt: skip

STUDY: Final = Study(
    STUDIES["gains"],
    experiment,
    {"mi": (WALK_MI, 0.2), "gain": tuple(sorted({g for grid in GAINS.values() for g in grid}))},
    controllers=tuple(GAINS),
    seeds=seeds,
    measure=measure,
    claims=CLAIMS,
    figures=figures,
    table=table,
)
