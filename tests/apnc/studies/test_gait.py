"""How it walks: the figures of the worst foot, and every aim with results for each verdict."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from made_up_results import Result, made_up
from records import LIFT, synthetic_record

from apnc.loop.record import End, Record
from apnc.studies import gait
from apnc.studies.claims import NO, PARTLY, YES, judgements
from apnc.studies.runner import grid_of

MIS = gait.MI_VALUES


def results(figures: Callable[[Result], Result]) -> list[Result]:
    return made_up({"mi": MIS}, figures, controllers=("apnc",), study="gait")


def verdict(text: str, **figures: Any) -> str:
    """Verdict of an aim on results with these figures, which may depend on MI and seed."""

    def of(cell: Result) -> Result:
        return {name: f(cell["mi"], cell["seed"]) for name, f in figures.items()}

    (aim,) = [aim for aim in gait.AIMS if aim.text.startswith(text)]
    return judgements(results(of), [aim])[0][1].verdict


@pytest.mark.parametrize(
    ("time", "every", "median"),
    [
        (lambda mi, seed: 2.0, YES, YES),
        (lambda mi, seed: None if mi == 0.12 and seed == 0 else 2.0, PARTLY, YES),
        (lambda mi, seed: None if mi > 0.1 else 2.0, NO, NO),
        (lambda mi, seed: 3.5 if mi == 0.2 else 2.0, YES, PARTLY),
        (lambda mi, seed: 2.0 if mi < 0.07 else 4.0, YES, NO),
        (lambda mi, seed: 4.0 if mi < 0.07 else 2.0, YES, YES),
        (lambda mi, seed: None if mi == 0.4 else 2.0, PARTLY, PARTLY),
    ],
)
def test_formation(time: Any, every: str, median: str) -> None:
    of = {"convergence_time_s": time}
    assert verdict("strict {gait} in every run", **of) == every
    assert verdict("within 3 s", **of) == median


@pytest.mark.parametrize(
    ("text", "column", "good", "bad"),
    [
        ("every foot lifts", gait.LIFT, 6.5, 4.5),
        ("no foot slips", gait.SLIP, 0.11, 0.13),
        ("every foot touches", gait.TOUCHES, 1.02, 1.3),
        ("every foot touches", gait.TOUCHES, 0.98, 0.8),
        ("straight", gait.TURNED, -9.0, -21.0),
    ],
)
def test_a_measure_over_mi(text: str, column: str, good: float, bad: float) -> None:
    assert verdict(text, **{column: lambda mi, seed: good}) == YES
    assert verdict(text, **{column: lambda mi, seed: bad if mi == 0.2 else good}) == PARTLY
    assert verdict(text, **{column: lambda mi, seed: bad if mi < 0.35 else good}) == NO
    # one run of six does not move the median, most runs without the figure do
    assert verdict(text, **{column: lambda mi, seed: bad if seed == 0 else good}) == YES
    assert verdict(text, **{column: lambda mi, seed: None if seed < 4 else good}) == NO


@pytest.mark.parametrize(
    ("text", "column", "mi", "value", "found"),
    [
        ("every foot lifts", gait.LIFT, 0.04, 1.0, YES),  # nothing is asked of it there
        ("every foot lifts", gait.LIFT, 0.40, 5.5, YES),
        ("every foot lifts", gait.LIFT, 0.34, 5.5, PARTLY),
        ("no foot slips", gait.SLIP, 0.10, 0.5, YES),
        ("straight", gait.TURNED, 0.10, 15.0, YES),
        ("straight", gait.TURNED, 0.12, 15.0, PARTLY),
    ],
)
def test_limits_hold_in_their_part_of_the_range(
    text: str, column: str, mi: float, value: float, found: str
) -> None:
    good = {gait.LIFT: 6.5, gait.SLIP: 0.1, gait.TURNED: 5.0}[column]
    of = {column: lambda at, seed: value if at == mi else good}
    assert mi in MIS
    assert verdict(text, **of) == found


def changed(record: Record, **signals: Any) -> Record:
    return replace(record, signals={**record.signals, **signals})


def test_figures_of_a_walk_on_clean_feet() -> None:
    found = gait.measure(synthetic_record(30.0))
    assert found[gait.LIFT] == pytest.approx(1000.0 * LIFT, rel=0.05)
    assert found[gait.TOUCHES] == pytest.approx(1.0, abs=0.02)
    assert found[gait.SLIP] == pytest.approx(0.0, abs=0.02)


def test_the_worst_foot_counts_and_only_from_ten_seconds_on() -> None:
    record = synthetic_record(30.0)
    late, feet = record.time >= 10.0, record.signals["foot_position"].copy()
    feet[late, 1, 2] *= 0.5  # half the lift
    # the stride is 0.08 / 1.4 = 57 mm; this foot slides a tenth of it while it stands
    standing = record.signals["foot_force"][:, 2, 2] > 0.0
    feet[:, 2, 1] += np.cumsum(standing * late) * 0.1 * (0.08 / 1.4) / (0.6 / 1.4 * 60.0)
    found = gait.measure(changed(record, foot_position=feet))
    assert found[gait.LIFT] == pytest.approx(500.0 * LIFT, rel=0.1)
    assert found[gait.SLIP] == pytest.approx(0.1, abs=0.02)
    feet[~late] = 0.0
    assert gait.measure(changed(record, foot_position=feet)) == found


def test_a_foot_that_touches_twice_is_the_worst_of_clean_ones() -> None:
    record = synthetic_record(30.0)
    force = record.signals["foot_force"].copy()
    down = force[:, 1, 2] > 0.0
    begins, ends = (np.flatnonzero(np.diff(down.astype(int)) == sign) for sign in (1, -1))
    for begin in begins:
        middle = (begin + ends[ends > begin].min(initial=len(down))) // 2
        force[middle - 2 : middle + 3, 1] = 0.0  # lifted for five samples in every stance
    assert gait.measure(changed(record, foot_force=force))[gait.TOUCHES] == pytest.approx(2.0)


def test_a_run_that_ended_early_or_stands_has_no_figures() -> None:
    record = synthetic_record(30.0)
    none = dict.fromkeys((gait.LIFT, gait.SLIP, gait.TOUCHES))
    assert gait.measure(replace(record, end=End.fell)) == none
    assert gait.measure(synthetic_record(5.0)) == none
    assert gait.measure(synthetic_record(30.0, speed=0.0)) == none


def test_every_mi_is_walked_from_the_start() -> None:
    trials = grid_of("gait", 2)
    assert [t.experiment.mi for t in trials[::2]] == list(MIS) and {0.04, 0.28, 0.4} <= set(MIS)
    assert all(t.experiment.duration == 45.0 and t.experiment.controller == "apnc" for t in trials)


def test_a_line_per_mi() -> None:
    found = gait.table(results(lambda cell: {gait.LIFT: 7.0, gait.TURNED: -12.0, gait.SLIP: 0.1}))
    assert len(found.splitlines()) == 2 + len(MIS)
    assert "7.0 (7.0 ... 7.0)" in found and "12 (12 ... 12)" in found and "10 (10" in found
