"""How the robot walks over MI: formation, feet, turn and speed, each with its aim."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final, NamedTuple

import numpy as np

from apnc.feet import Feet
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies.claims import Claim, Judgement, Rule, verdict
from apnc.studies.plots import over_axis
from apnc.studies.registry import STUDIES
from apnc.studies.results import STRICT, Result, cells_in, gait_in, matching, successes, values
from apnc.studies.statistics import rate
from apnc.studies.study import WALK_S, Study
from apnc.studies.table import markdown, middle

MI_VALUES: Final = (*(round(0.04 + 0.02 * i, 2) for i in range(13)), 0.31, 0.34, 0.37, 0.40)
"""MI at which the walk starts and stays."""

QUICK: Final = (0.08, 0.40)
"""MI of the range in which the gait is to form quickly."""

SETTLED_S: Final = 10.0
"""Time from which the feet are measured. The gait has formed and the couplings are on [s]."""

AXIS: Final = ("mi", "MI [1]")
LIFT, SLIP, TOUCHES = "lowest_lift_mm", "largest_slip_share", "worst_touch_downs"
TURNED, LATE_SPEED = "turned_deg", "late_speed_m_per_s"


def measure(record: Record) -> Result:
    """Figures of the worst foot from 10 s on. None for a run that is not complete.

    Returns:
        ``lowest_lift_mm``: smallest lift in mid-swing of a foot [mm].
        ``largest_slip_share``: largest slip of a foot in a stride, over the stride length [1].
        ``worst_touch_downs``: touch-downs of a foot in a stride, of the foot furthest from one [1].
    """
    begin = int(np.searchsorted(record.time, SETTLED_S))
    if not record.complete or len(record) - begin < 2:
        return dict.fromkeys((LIFT, SLIP, TOUCHES))
    feet = Feet(record, slice(begin, None))
    stride = feet.stride_length
    lifts, slips, touches = map(_known, (feet.lifts, feet.slips, feet.touch_downs))
    # a foot that never stands has no lift, and one that always stands has no stride
    every = len(lifts) == len(slips) == len(touches) == len(record.legs)
    if not every or stride is None:
        return dict.fromkeys((LIFT, SLIP, TOUCHES))
    return {
        LIFT: 1000.0 * min(lifts),
        SLIP: max(slips) / stride,
        TOUCHES: max(touches, key=lambda count: abs(count - 1.0)),
    }


def _known(figures: Sequence[float | None]) -> list[float]:
    return [figure for figure in figures if figure is not None]


def forms(low: float, high: float, share: float) -> Rule:
    """Rule: a share of the runs forms the gait by the strict criterion at every MI of a range.

    Partly if it does at more than half of them.
    """

    def rule(results: Sequence[Result]) -> Judgement:
        mis = [mi for mi in cells_in(results, "mi") if low <= mi <= high]
        rates = {mi: rate(successes(results, mi=mi)) for mi in mis}
        reached = sum(found.value >= share for found in rates.values())
        short = [f"MI {mi:g}: {hit}" for mi, hit in rates.items() if hit.value < share]
        text = f"at {reached} of {len(mis)} MI" + (f"; {', '.join(short)}" if short else "")
        return Judgement(text, verdict(reached == len(mis) > 0, reached > len(mis) / 2))

    return rule


def quickly(limit: float) -> Rule:
    """Rule: the median strict time is at most a limit [s] at every MI of ``QUICK``.

    Partly if it is at more than half of them.
    """

    def rule(results: Sequence[Result]) -> Judgement:
        own = [result for result in results if QUICK[0] <= result["mi"] <= QUICK[1]]
        times = _by_mi(own, STRICT)
        medians = {mi: float(np.median(found)) for mi, found in times.items() if found}
        if not medians:
            return Judgement("no run forms the gait", verdict(False, False))
        low, high = min(medians.values()), max(medians.values())
        quick = sum(value <= limit for value in medians.values())
        longest = max(max(found) for found in times.values() if found)
        text = (
            f"at {quick} of {len(times)} MI; medians {low:.1f} ... {high:.1f} s, "
            f"longest run {longest:.1f} s"
        )
        return Judgement(text, verdict(quick == len(times), quick > len(times) / 2))

    return rule


class Part(NamedTuple):
    """Limits of a measure in a part of the MI range.

    Args:
        mi: first and last MI.
        fits: smallest and largest allowed median.
    """

    mi: tuple[float, float]
    fits: tuple[float, float]


def worst(column: str, unit: str, digits: int, scale: float, parts: Sequence[Part]) -> Rule:
    """Rule: the median of the magnitude of a measure is inside its limits at every MI of a part.

    Partly if it is at more than half of them. The median is outside if half of the runs or more
    lack the measure.

    Args:
        column: the measure.
        unit: unit in the text of the judgement.
        digits: digits after the point in that text.
        scale: factor on the measure in that text.
        parts: limits; of MI in no part nothing is asked.
    """

    def rule(results: Sequence[Result]) -> Judgement:
        inside, count, texts = 0, 0, []
        for mi in cells_in(results, "mi"):
            own = matching(results, mi=mi)
            for low, high in (part.fits for part in parts if part.mi[0] <= mi <= part.mi[1]):
                found = np.abs(values(own, column))
                median = float(np.median(found)) if len(found) > len(own) / 2 else None
                fit = median is not None and low <= median <= high
                inside, count = inside + fit, count + 1
                if not fit:
                    shown = "-" if median is None else f"{scale * median:.{digits}f}"
                    texts.append(f"{shown} at {mi:g}")
        text = f"at {inside} of {count} MI" + (f"; {unit} {', '.join(texts)}" if texts else "")
        return Judgement(text, verdict(inside == count > 0, inside > count / 2))

    return rule


def _by_mi(results: Sequence[Result], column: str) -> dict[float, list[float]]:
    return {mi: values(results, column, mi=mi) for mi in cells_in(results, "mi")}


def table(results: Sequence[Result]) -> str:
    """A line per MI. A trial that ended with an error counts as a failure."""
    gait = gait_in(results)
    return markdown(_line(gait, mi, matching(results, mi=mi)) for mi in cells_in(results, "mi"))


def _line(gait: str, mi: float, results: list[Result]) -> dict[str, str]:
    turns = [abs(value) for value in values(results, TURNED)]
    slips = [100.0 * value for value in values(results, SLIP)]
    return {
        "MI": f"{mi:.2f}",
        f"strict {gait}": f"{sum(successes(results))}/{len(results)}",
        "after [s], median (range)": middle(values(results, STRICT), 1),
        "lowest lift of a foot [mm]": middle(values(results, LIFT), 1),
        "largest slip of a foot [% of the stride]": middle(slips, 0),
        "touch-downs of the worst foot": middle(values(results, TOUCHES), 2),
        "turn in 45 s [deg]": middle(turns, 0),
        "speed [m/s]": middle(values(results, LATE_SPEED), 3),
        "stride [Hz]": middle(values(results, "stride_frequency_hz"), 2),
        "duty factor": middle(values(results, "duty_factor_mean"), 2),
        "fell": str(len(matching(results, fell=True))),
    }


ALL_MI: Final = (0.0, 1.0)

AIMS: Final = (
    Claim("aim", "strict {gait} in every run at every MI", forms(*ALL_MI, 1.0)),
    Claim("aim", "within 3 s from MI 0.08 up, in the median", quickly(3.0)),
    Claim("aim", "every foot lifts by 6 mm in mid-swing from MI 0.06 to 0.34, by 5 mm above",
          worst(LIFT, "mm:", 1, 1.0, (
              Part((0.06, 0.34), (6.0, np.inf)), Part((0.35, 1.0), (5.0, np.inf))))),
    Claim("aim", "no foot slips by more than 12 % of the stride from MI 0.12 up",
          worst(SLIP, "%:", 1, 100.0, (Part((0.12, 1.0), (0.0, 0.12)),))),
    Claim("aim", "every foot touches down once in a stride",
          worst(TOUCHES, "number:", 2, 1.0, (Part(ALL_MI, (0.95, 1.05)),))),
    Claim("aim", "straight: a turn of at most 10 deg in 45 s from MI 0.12 up, of 20 deg below, in "
          "the median",
          worst(TURNED, "deg:", 0, 1.0, (
              Part((0.12, 1.0), (0.0, 10.0)), Part((0.0, 0.11), (0.0, 20.0))))),
)  # fmt: skip
"""Aims of the robot's design. They are no claims of the paper."""

STUDY: Final = Study(
    STUDIES["gait"],
    partial(Experiment, duration=WALK_S),
    {"mi": MI_VALUES},
    controllers=("apnc",),
    measure=measure,
    claims=AIMS,
    figures=lambda results: [
        over_axis(results, AXIS, LIFT, "lowest lift of a foot [mm]"),
        over_axis(results, AXIS, SLIP, "largest slip of a foot [strides]"),
        over_axis(results, AXIS, TURNED, "turn [deg]"),
        over_axis(results, AXIS, LATE_SPEED, "speed [m/s]"),
    ],
    table=table,
)
