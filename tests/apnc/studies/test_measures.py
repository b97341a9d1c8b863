"""Measures of the studies on made-up records with closed-form answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from records import TRIPOD, TROT, outputs, synthetic_record

from apnc.loop.record import End, Record
from apnc.studies import gains, mi, steering
from apnc.studies.registry import STUDIES
from apnc.studies.results import Result
from apnc.studies.runner import measured
from apnc.studies.states.measure import as_paper_says, judge, measure
from apnc.studies.states.timeline import TIMELINE, Timeline

PRONK = (0.0, 0.0, 0.0)

# --- S1 to S3 ----------------------------------------------------------------------------------


def states_record(
    phases: Sequence[tuple[float, Sequence[float]]] = ((0.0, TROT),),
    speeds: Sequence[tuple[float, float]] = ((0.0, 0.1),),
    *,
    controller: str = "apnc",
    stops: Sequence[tuple[float, float, int]] = (),
    stored: float = 6.0,
    duration: float = TIMELINE.end,
) -> Record:
    """A run whose phases and speed change in steps, whose oscillators (begin, end, leg) stop."""
    base = synthetic_record(duration)
    t = base.time
    lead = np.zeros((len(t), 4))
    speed = np.zeros(len(t))
    for start, values in phases:
        lead[t >= start, 1:] = values
    for start, value in speeds:
        speed[t >= start] = value
    o1, o2 = outputs(2 * np.pi * 1.4 * t[:, None] + lead)
    for begin, end, leg in stops:
        inside = (t >= begin) & (t < end)
        o1[inside, leg], o2[inside, leg] = 0.3, 0.1
    position = np.column_stack([np.cumsum(speed) / 60.0, 0 * t, 0 * t + 0.148])
    experiment = replace(TIMELINE.experiment(controller, 0), duration=duration)
    return replace(
        base,
        experiment=experiment,
        signals={
            **base.signals,
            "position": position,
            "o1": o1,
            "o2": o2,
            "kappa": 1.0 * (t >= stored),
        },
    )


def test_a_trot_all_along_is_as_the_paper_says_with_couplings() -> None:
    result = measure(states_record())
    assert result["state_formed"] and result["state_kept"] and result["state_recovered"]
    assert (
        not result["state_front_stopped"]
        and not result["state_in_phase"]
        and not result["state_fell"]
    )
    assert (result["state_S1"], result["state_S2"], result["state_S3"]) == (True, True, True)
    assert result["state_formation_time_s"] == pytest.approx(0.0, abs=1 / 60)
    assert result["state_recovery_time_s"] == pytest.approx(0.0, abs=1 / 60)
    assert result["state_stored_at_s"] == pytest.approx(6.0)


def test_times_count_from_the_set_down_and_the_restart() -> None:
    record = states_record(((0.0, PRONK), (5.0, TROT), (20.0, PRONK), (26.0, TROT)))
    found = judge(record)
    # the phases are smoothed over 1.5 s
    assert found["formation_time_s"] == pytest.approx(5.0 - 1.7, abs=0.8)
    assert found["recovery_time_s"] == pytest.approx(26.0 - 24.0, abs=0.8)


def test_a_gait_that_does_not_last_to_the_break_has_not_formed() -> None:
    found = judge(states_record(((0.0, TROT), (13.5, PRONK), (14.0, TROT))))
    assert not found["formed"] and found["formation_time_s"] is None
    assert found["recovered"]


def test_s2_is_kept_at_every_moment() -> None:
    assert judge(states_record())["kept"]
    lost = judge(states_record(((0.0, TROT), (16.0, PRONK), (18.0, TROT))))
    assert not lost["kept"] and lost["formed"] and lost["recovered"]
    before = judge(states_record(((0.0, TROT), (10.0, PRONK), (12.0, TROT))))
    assert before["kept"]


def test_front_oscillators_have_two_seconds_to_stop() -> None:
    front = [(16.0, 20.0, 0), (16.0, 20.0, 2)]
    assert judge(states_record(stops=front))["front_stopped"]
    assert not judge(states_record(stops=front[:1]))["front_stopped"]
    late = [(17.0, 20.0, 0), (17.0, 20.0, 2)]
    assert not judge(states_record(stops=late))["front_stopped"]
    hind = [(16.0, 20.0, 1), (16.0, 20.0, 3)]
    assert not judge(states_record(stops=hind))["front_stopped"]


def test_front_oscillators_may_stop_anywhere() -> None:
    record = states_record(stops=[(16.0, 20.0, 0), (16.0, 20.0, 2)])
    o1 = record.signals["o1"].copy()
    o1[(record.time >= 16.0) & (record.time < 20.0), 2] = -0.8
    assert judge(replace(record, signals={**record.signals, "o1": o1}))["front_stopped"]


def test_a_touch_bears_a_fifth_of_the_weight() -> None:
    record = states_record(((0.0, PRONK), (5.0, TROT)))
    force = record.signals["foot_force"].copy()
    force[record.time < 4.0] *= 0.05
    light = replace(record, signals={**record.signals, "foot_force": force})
    later = judge(record)["formation_time_s"] - judge(light)["formation_time_s"]
    assert later == pytest.approx(4.0 - 1.7, abs=0.3)


def test_in_phase_is_the_last_second() -> None:
    assert judge(states_record(((0.0, TROT), (30.0, PRONK))))["in_phase"]
    assert not judge(states_record())["in_phase"]
    assert not judge(states_record(((0.0, PRONK), (33.2, TROT))))["in_phase"]


def test_speeds_are_those_of_the_last_three_seconds_of_each_state() -> None:
    steps = ((0.0, 0.5), (10.0, 0.1), (14.7, 0.5), (16.2, 0.2), (20.7, 0.5), (30.2, 0.3))
    found = judge(states_record(speeds=steps))
    speeds = [found[f"speed_s{i}"] for i in (1, 2, 3)]
    assert speeds == pytest.approx([0.1, 0.2, 0.3], abs=0.01)


def test_never_stored() -> None:
    assert judge(states_record(stored=99.0))["stored_at_s"] is None


def test_gamma_is_the_mean_before_the_couplings_and_at_the_end_of_s1() -> None:
    record = states_record(stored=6.0)
    t = record.time
    by_time = np.select([t < 4, t < 6, t < 12, t < 14], [9.0, 0.3, 9.0, 0.1], 9.0)
    gamma = by_time[:, None] * np.array([0.0, 1.0, 1.0, 2.0])
    found = judge(replace(record, signals={**record.signals, "gamma": gamma}))
    assert (found["gamma_before"], found["gamma_after"]) == pytest.approx((0.3, 0.1))


@pytest.mark.parametrize("stored", [3.6, 12.1, 99.0])
def test_without_two_seconds_on_either_side_gamma_is_not_told(stored: float) -> None:
    found = judge(states_record(stored=stored))
    assert found["gamma_before"] is None and found["gamma_after"] is None


BASE: Result = {
    "formed": True,
    "kept": True,
    "front_stopped": True,
    "recovered": True,
    "in_phase": True,
    "speed_s2": 0.03,
    "speed_s3": 0.01,
}


@pytest.mark.parametrize(
    ("controller", "changed", "expected"),
    [
        ("apnc", {"speed_s3": 0.03}, (True, True, True)),
        ("apnc", {"speed_s3": 0.03, "formed": False}, (False, True, True)),
        ("apnc", {"speed_s3": 0.03, "kept": False}, (True, False, True)),
        ("apnc", {"speed_s3": 0.03, "speed_s2": 0.029}, (True, False, True)),
        ("apnc", {"speed_s3": 0.03, "recovered": False}, (True, True, False)),
        ("apnc", {"speed_s3": 0.029}, (True, True, False)),
        ("tegotae", {"speed_s3": 0.03}, (True, True, True)),
        ("tegotae", {"speed_s3": 0.03, "kept": False}, (True, False, True)),
        ("phase_reset", {"recovered": False}, (True, True, False)),
        ("apc", {}, (True, True, True)),
        ("apc", {"formed": False}, (False, True, True)),
        ("apc", {"front_stopped": False}, (True, False, True)),
        ("apc", {"in_phase": False}, (True, True, False)),
        ("apc", {"speed_s3": 0.011}, (True, True, False)),
        ("apc", {"speed_s3": -0.011}, (True, True, False)),
    ],
)
def test_as_the_paper_says(controller: str, changed: Result, expected: tuple[bool, ...]) -> None:
    found = as_paper_says(BASE | changed, controller)
    assert (found["S1"], found["S2"], found["S3"]) == expected


def test_a_larger_robot_has_to_be_faster_to_walk_and_may_be_to_rock() -> None:
    slow = BASE | {"speed_s2": 0.05, "speed_s3": 0.05}
    assert as_paper_says(slow, "apnc")["S2"] and as_paper_says(slow, "apnc")["S3"]
    assert not as_paper_says(slow, "apnc", 2.0)["S2"] and not as_paper_says(slow, "apnc", 2.0)["S3"]
    rocking = BASE | {"front_stopped": True, "in_phase": True, "speed_s3": 0.015}
    assert [as_paper_says(rocking, "apc", f)["S3"] for f in (1.0, 2.0)] == [False, True]


@pytest.mark.parametrize("end", [End.fell, End.diverged, End.interrupted])
def test_a_run_that_ended_early_went_as_nothing_in_the_paper(end: End) -> None:
    record = replace(states_record(duration=10.0), end=end)
    record = replace(record, experiment=TIMELINE.experiment("apnc", 0))
    assert measure(record) == {
        "state_S1": False,
        "state_S2": False,
        "state_S3": False,
        "state_fell": end is End.fell,
    }


def test_a_shorter_run_is_none_of_the_states() -> None:
    assert measure(states_record(duration=20.0))["state_S1"] is False


def test_without_couplings_the_method_decides() -> None:
    assert measure(states_record(controller="apc"))["state_S2"] is False


@pytest.mark.parametrize(
    "times",
    [{"lowered": -1.0}, {"broken": 1.0}, {"stopped": 14.0}, {"restarted": 1.0}, {"end": 24.0}],
)
def test_times_must_follow_each_other(times: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="do not follow each other"):
        Timeline(**times)


def test_a_robot_may_stand_from_the_start() -> None:
    experiment = Timeline(0.0, 3.0, 8.0, 9.0, 14.0).experiment("apnc", 0)
    assert experiment.conditions == ((0.0, "C1"), (3.0, "S2"), (8.0, "S3"))
    assert TIMELINE.experiment("apc", 0, settings={"xi": 0.02}).settings == {"xi": 0.02}


# --- schedules -----------------------------------------------------------------------------------


def on_schedule(schedule: str, signals: dict[str, Any], ended: float = 60.0) -> Record:
    base = synthetic_record(ended)
    experiment = steering.experiment(schedule)
    end = End.complete if ended == 60.0 else End.fell
    return replace(base, experiment=experiment, signals={**base.signals, **signals}, end=end)


def test_yaw_rate_is_that_of_each_interval_after_five_seconds() -> None:
    t = synthetic_record(60.0).time
    rate = np.select([t < 25, t < 35, t < 40, t < 50, t < 55], [0.0, -0.2, 9.0, 0.3, 9.0], 0.1)
    yaw = np.cumsum(rate) / 60.0
    rpy = np.column_stack([0 * t, 0 * t, np.angle(np.exp(1j * yaw))])
    result = steering.measure(on_schedule("turns", {"rpy": rpy}))
    found = [result[f"yaw_rate_section_{i}"] for i in (1, 2, 3, 4)]
    assert found == pytest.approx([0.0, -0.2, 0.3, 0.1], rel=0.01)
    assert len(result) == 4


def test_speed_is_that_of_each_interval_after_five_seconds() -> None:
    t = synthetic_record(60.0).time
    speed = np.select([t < 5, t < 25, t < 30, t < 40, t < 45], [9.0, 0.08, 9.0, 0.16, 9.0], 0.1)
    way = np.cumsum(speed) / 60.0
    position = np.column_stack([0.6 * way, 0.8 * way, 5 * np.sin(t)])
    rpy = np.column_stack([0 * t, 0 * t, 0 * t + np.arctan2(0.8, 0.6)])
    result = steering.measure(on_schedule("speeds", {"position": position, "rpy": rpy}))
    found = [result[f"speed_section_{i}"] for i in (1, 2, 3)]
    assert found == pytest.approx([0.08, 0.16, 0.1], rel=0.01)
    assert len(result) == 3


def test_a_robot_that_walks_in_a_circle_has_its_speed() -> None:
    """At its end it is where it began: the way there and back is no distance."""
    t = synthetic_record(60.0).time
    turn = 2 * np.pi / 10.0  # rad/s, once round in an interval after its settling
    yaw = turn * t
    place = 0.1 / turn * np.column_stack([np.sin(yaw), -np.cos(yaw), 0 * t])
    rpy = np.column_stack([0 * t, 0 * t, np.angle(np.exp(1j * yaw))])
    result = steering.measure(on_schedule("speeds", {"position": place, "rpy": rpy}))
    assert [result[f"speed_section_{i}"] for i in (1, 2, 3)] == pytest.approx([0.1] * 3, rel=0.03)


def test_a_walk_on_other_slopes_has_one_interval() -> None:
    result = steering.measure(
        replace(synthetic_record(25.0), experiment=steering.experiment("slopes x 0.8"))
    )
    assert result == {"speed_section_1": pytest.approx(0.08, rel=0.01)}


def test_an_interval_not_walked_to_its_end_has_no_speed() -> None:
    result = steering.measure(on_schedule("speeds", {}, ended=39.0))
    assert result["speed_section_1"] == pytest.approx(0.08, rel=0.01)
    assert result["speed_section_2"] is None and result["speed_section_3"] is None
    result = steering.measure(on_schedule("turns", {}, ended=1.0))
    assert set(result.values()) == {None}


# --- gains -------------------------------------------------------------------------------------


def test_an_oscillator_that_hardly_moves_at_the_end_has_stopped() -> None:
    base = synthetic_record(20.0)
    late = base.time >= 16.0
    o1 = base.signals["o1"].copy()
    o1[late, 0], o1[late, 2] = 0.5, 0.1 * o1[late, 2]
    record = replace(base, signals={**base.signals, "o1": o1})
    assert gains.measure(base) == {gains.STILL: 0}
    assert gains.measure(record) == {gains.STILL: 2}
    o1[base.time >= 18.5, 0] = -0.5  # moves within the last three seconds
    assert gains.measure(record) == {gains.STILL: 1}


def setting_results(
    *by_gain: tuple[float, int, float, float],
) -> list[Result]:
    """Gain, strict formations of four, authors' time and speed."""
    return [
        {
            "gain": gain,
            "convergence_time_s": 30.0 if seed < strict else None,
            "convergence_time_authors_s": time,
            "late_speed_m_per_s": speed,
            "fell": False,
        }
        for gain, strict, time, speed in by_gain
        for seed in range(4)
    ]


@pytest.mark.parametrize(
    ("by_gain", "best"),
    [
        (((0.1, 3, 9.0, 0.1), (0.2, 4, 20.0, 0.1), (0.3, 2, 1.0, 0.1)), 0.2),  # most in the trot
        (((0.1, 4, 9.0, 0.1), (0.2, 4, 2.0, 0.1), (0.3, 4, 3.0, 0.1)), 0.2),  # then the first
        (((0.1, 4, 2.0, 0.029), (0.2, 1, 9.0, 0.03)), 0.2),  # one that stands does not count
        (((0.3, 4, 2.0, 0.1), (0.1, 4, 2.0, 0.1)), 0.1),  # then the weaker
        (((0.1, 0, 2.0, 0.1), (0.2, 4, 2.0, 0.0)), 0.1),  # none walks in the strict trot
        (((0.1, 4, 2.0, 0.0), (0.2, 4, 2.0, 0.02)), None),  # none walks at all
        ((), None),
    ],
)
def test_the_best_setting(
    by_gain: tuple[tuple[float, int, float, float], ...], best: float | None
) -> None:
    assert gains.best_setting(setting_results(*by_gain)) == best


def test_a_run_that_fell_or_has_no_figures_is_no_walk() -> None:
    results = setting_results((0.1, 4, 2.0, 0.1))
    results[0]["fell"] = True
    results[1] = {"gain": 0.1, "error": "moo"}
    assert gains.walks(results) == 2


def test_without_a_strict_trot_the_most_by_the_authors_criterion_are_best() -> None:
    results = setting_results((0.1, 0, 1.0, 0.1), (0.2, 0, 9.0, 0.1))
    results[0]["convergence_time_authors_s"] = None
    assert gains.best_setting(results) == 0.2


def test_never_is_later_than_any_time() -> None:
    results = setting_results((0.1, 0, 40.0, 0.1), (0.2, 0, 5.0, 0.1))
    for standing, without in zip(
        results[:3], results[4:7], strict=True
    ):  # one walk of each is left
        standing["late_speed_m_per_s"] = 0.0
        without["convergence_time_authors_s"] = None
    assert gains.best_setting(results) == 0.1


# --- results --------------------------------------------------------------------------------------


def test_a_result_has_the_summary_and_how_the_run_ended() -> None:
    result = measured(STUDIES["mi"], synthetic_record(20.0))
    assert result["converged"] is True and result["convergence_time_s"] == pytest.approx(
        0.0, abs=0.1
    )
    assert result["phi_final_12"] == pytest.approx(np.pi, abs=0.01)
    assert result["phi_final_14"] == pytest.approx(0.0, abs=0.01)
    # the half-sine load is above a tenth of its peak for this share of a stance of 0.6
    share = 1.0 - 2.0 * np.arcsin(0.1) / np.pi
    assert result["duty_factor_mean"] == pytest.approx(0.6 * share, abs=0.01)
    assert result["stride_frequency_hz"] == pytest.approx(1.4, rel=0.01)
    assert (result["end"], result["error"], result["ended_at_s"]) == ("complete", "", 20.0)
    assert not set(result) & {
        "controller",
        "seed",
        "mi",
        "duration_s",
        "message",
        "real_time_factor",
    }
    assert not any(isinstance(value, dict | tuple | list) for value in result.values())


def test_a_fall_and_a_divergence_are_told_in_the_result() -> None:
    fell = measured(STUDIES["mi"], replace(synthetic_record(20.0), end=End.fell))
    assert fell["end"] == "fell" and fell["fell"] is True and fell["error"] == ""
    assert fell["convergence_time_s"] is None
    broken = replace(synthetic_record(5.0), end=End.diverged, message="it diverged")
    assert measured(STUDIES["mi"], broken)["error"] == "it diverged"


@pytest.mark.parametrize(
    ("phases", "name"),
    [
        (TROT, "trot"),
        ((np.pi + 0.5, np.pi - 0.5, 0.0), "trot"),
        ((np.pi + 0.7, np.pi, 0.0), "no name"),
        (TRIPOD, "tripod"),
        ((2 * np.pi / 3, 4 * np.pi / 3, 0.0, 2 * np.pi / 3, 4 * np.pi / 3), "direct wave of pairs"),
    ],
)
def test_the_gait_at_the_end_has_its_name(phases: Sequence[float], name: str) -> None:
    assert mi.measure(synthetic_record(20.0, phases)) == {mi.GAIT: name}


def test_a_gait_that_is_not_settled_or_fell_has_no_name() -> None:
    on_the_way = synthetic_record(20.0, formation=(14.0, 20.0))
    assert mi.measure(on_the_way) == {mi.GAIT: "unsettled"}
    fell = replace(synthetic_record(20.0), end=End.fell)
    assert mi.measure(fell) == {mi.GAIT: None}
