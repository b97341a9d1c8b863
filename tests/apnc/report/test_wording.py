"""What is said of a run: heading, facts, verdicts, and every figure under its own name."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from records import QUADRUPED, TRIPOD, synthetic_record

from apnc.features import WalkFeatures, walk_features
from apnc.loop.experiment import Experiment
from apnc.report.wording import facts, heading, rows, verdicts
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Obstacles

SHOWN = {
    "path_speed_m_per_s": ("Speed along the path", 0.123, "0.123 m/s"),
    "turned_deg": ("Turned", 12.0, "12° left"),
    "forward_speed_m_per_s": ("Forward speed", 0.117, "0.117 m/s"),
    "distance_m": ("Net displacement", 3.21, "3.21 m"),
    "duration_s": ("Simulated", 43.21, "43.21 s"),
    "convergence_time_s": ("Trot, strict", 7.25, "7.25 s"),
    "convergence_time_authors_s": ("Trot, authors", 4.5, "4.50 s"),
    "gait": ("Final gait", "bound", "bound"),
    "stored_at_s": ("Gait stored", 8.75, "8.75 s"),
    "stride_frequency_hz": ("Stride frequency", 1.75, "1.75 Hz"),
    "stride_length_mm": ("Stride length", 65.4, "65.4 mm"),
    "balance": ("Balance", 98.7, "98.7 1/rad"),
    "coordination": ("Coordination", 5.4, "5.4"),
    "cost_of_transport": ("Cost of transport", 1.62, "1.62"),
    "real_time_factor": ("Real-time factor", 23.4, "23.4 ×"),
    "fmu_share_of_wall_time": ("Controller's share", 0.125, "12.5 %"),
}
"""Figures: name in the table, a value like no other, and how it reads."""


def told() -> WalkFeatures:
    figures = {name: value for name, (_, value, _) in SHOWN.items()} | {
        "leftmost_heading_deg": None
    }
    return replace(walk_features(synthetic_record(10.0)), **figures)  # type: ignore[arg-type]


def test_every_figure_stands_under_its_name() -> None:
    shown = {name: (value.replace("\xa0", " "), about) for name, value, about in rows(told())}
    for name, _, words in SHOWN.values():
        assert shown[name][0] == words
    assert shown["Trot, strict"][1] == "within 0.6 rad to the end"
    assert shown["Trot, authors"][1] == "first within 2.8 rad"


def test_figures_of_legs_stand_at_their_leg() -> None:
    legs = ("RF", "RH", "LF", "LH")
    for place, (field, name, unit) in enumerate(
        [
            ("duty_factor", "Duty factor", 1.0),
            ("foot_lift_mm", "Foot lift", 1.0),
            ("slip_per_stride_mm", "Slip per stride", 1.0),
            ("slip_share", "Slip share", 100.0),
            ("touch_downs_by_leg", "Touch-downs per stride", 1.0),
        ]
    ):
        values = {leg: 1.0 + place + k for k, leg in enumerate(legs)}
        summary = replace(told(), **{field: values})  # type: ignore[arg-type]
        (shown,) = [value for row, value, _ in rows(summary) if row == name]
        parts = shown.split(";")[0].split(", ")
        found = {leg: float(number) for leg, number in (part.split("\xa0") for part in parts)}
        assert found == {leg: unit * value for leg, value in values.items()}


def test_the_verdict_tells_the_strict_time_and_the_authors_where_it_did_not_last() -> None:
    _, formed, _ = verdicts(told(), 45.0)
    assert formed.answer.replace("\xa0", " ") == "After 7.2 s"
    lost = replace(told(), converged=False, convergence_time_s=None)
    _, formed, _ = verdicts(lost, 45.0)
    assert formed.answer == "Not for good" and "near it at 4.5" in formed.detail


GOOD = replace(walk_features(synthetic_record(10.0)), convergence_time_s=2.0)


@pytest.mark.parametrize(
    ("change", "answers", "moods"),
    [
        ({}, ["Yes", "After 2.0\xa0s"], ["good", "good"]),
        ({"end": "fell", "complete": False}, ["It fell", "–"], ["bad", "plain"]),
        ({"end": "diverged", "complete": False}, ["It diverged", "–"], ["bad", "plain"]),
        ({"end": "interrupted", "complete": False}, ["Interrupted", "After 2.0\xa0s"], None),
        ({"path_speed_m_per_s": 0.001}, ["No", "After 2.0\xa0s"], ["bad", "good"]),
        # Net displacement says nothing about a walk in a curve.
        ({"speed_m_per_s": -0.05, "distance_m": 0.1}, ["Yes", "After 2.0\xa0s"], None),
        ({"converged": False}, ["Yes", "Not for good"], ["good", "fair"]),
        ({"converged": False, "convergence_time_authors_s": None}, ["Yes", "No"], ["good", "bad"]),
        ({"converged": None}, ["Yes", "–"], ["good", "plain"]),
    ],
)
def test_head_says_what_happened(
    change: dict[str, Any], answers: list[str], moods: list[str] | None
) -> None:
    found = verdicts(replace(GOOD, **change), 10.0)
    assert [v.answer for v in found[:2]] == answers
    assert moods is None or [v.mood for v in found[:2]] == moods


def shuffling() -> WalkFeatures:
    """Lilibot at MI 0.9 and robot_weight 5: backwards, and on feet that hardly leave the ground."""
    lifts = (0.0004, 0.0006, 0.0005, 0.001)
    return replace(
        GOOD,
        path_speed_m_per_s=0.107,
        forward_speed_m_per_s=-0.105,
        foot_lift_mm=dict(zip(QUADRUPED, (1000.0 * lift for lift in lifts), strict=True)),
        foot_lift_share=dict(zip(QUADRUPED, (lift / 0.155 for lift in lifts), strict=True)),
        slip_share=dict(zip(QUADRUPED, (1.1, 0.52, 1.08, 0.49), strict=True)),
    )


def test_a_shuffle_is_no_walk_and_the_sentence_says_what_is_missing() -> None:
    walked, _, fast = verdicts(shuffling(), 10.0)
    assert (walked.answer, walked.mood) == ("No", "bad")
    told = walked.detail.replace("\xa0", " ")
    assert "moved backwards by 1.05 m in 10.00 s" in told
    assert "All feet drag: they lift 0.4 to 1.0 mm" in told
    assert "slip 49 to 110 % of a stride" in told
    assert "lifts the foot by 2 % of the leg and slips at most 50 % of a stride" in told
    assert fast.answer == "–" and "did not walk" in fast.detail


@pytest.mark.parametrize(("ahead", "words"), [(-0.08, "backwards"), (0.01, "led forward")])
def test_walking_asks_for_forward_motion(ahead: float, words: str) -> None:
    walked = verdicts(replace(GOOD, forward_speed_m_per_s=ahead), 10.0)[0]
    assert walked.answer == "No" and words in walked.detail


@pytest.mark.parametrize(("field", "bad"), [("foot_lift_share", 0.01), ("slip_share", 0.9)])
def test_walking_asks_for_more_than_half_of_the_feet(field: str, bad: float) -> None:
    for count, answer in enumerate(("Yes", "Partly", "Partly", "No", "No")):
        feet = getattr(GOOD, field) | dict.fromkeys(QUADRUPED[:count], bad)
        walked, _, fast = verdicts(replace(GOOD, **{field: feet}), 10.0)
        assert walked.answer == answer
        assert fast.answer == ("–" if answer == "No" else "0.080\xa0m/s")


def test_the_foot_that_drags_is_named() -> None:
    slips = verdicts(replace(GOOD, slip_share=GOOD.slip_share | {"LF": 0.9}), 10.0)[0].detail
    assert "LF drags: it lifts" in slips and "90\xa0% of a stride" in slips
    unknown = replace(GOOD, foot_lift_share=GOOD.foot_lift_share | {"LF": None})
    assert verdicts(unknown, 10.0)[0].answer == "Partly"


def test_a_fall_has_no_speed_for_an_answer() -> None:
    fast = verdicts(replace(GOOD, end="fell", complete=False), 45.0)[2]
    assert fast.answer == "–" and "0.080\xa0m/s along the path" in fast.detail
    assert "until it fell" in fast.detail


def test_the_range_of_the_heading_is_told_beside_its_end() -> None:
    wide = replace(GOOD, turned_deg=2.0, rightmost_heading_deg=-12.0, leftmost_heading_deg=9.0)
    told = {name: value for name, value, _ in rows(wide)}["Turned"]
    assert told.replace("\xa0", " ") == "2° left (heading from 12° right to 9° left)"
    assert "from 12°\xa0right" in verdicts(wide, 10.0)[2].detail


@pytest.mark.parametrize("end", ["fell", "diverged", "interrupted"])
def test_an_early_end_is_said_with_its_time(end: str) -> None:
    walked = verdicts(replace(GOOD, end=end, complete=False, duration_s=7.25), 45.0)[0]
    assert walked.detail.startswith("at 7.25\xa0s")
    table = {name: (value, note) for name, value, note in rows(replace(GOOD, end=end))}
    assert table["Simulated"][1] == end


def test_path_speed_and_turn_lead_and_what_is_undefined_is_a_dash() -> None:
    curve = replace(GOOD, path_speed_m_per_s=0.146, turned_deg=-204.0, distance_m=0.17)
    fast = verdicts(curve, 45.0)[2]
    assert fast.answer == "0.146\xa0m/s"
    assert "turned 204°\xa0right" in fast.detail
    names = [name for name, _, _ in rows(curve)]
    assert names[:3] == ["Speed along the path", "Turned", "Forward speed"]
    standing = replace(GOOD, balance=None, coordination=None, path_speed_m_per_s=None)
    table = {name: value for name, value, _ in rows(standing)}
    assert table["Balance"] == table["Coordination"] == table["Speed along the path"] == "–"
    notes = {name: note for name, _, note in rows(GOOD)}
    assert "larger is steadier" in notes["Balance"]
    assert "larger is more even" in notes["Coordination"]


def test_feet_are_told_one_by_one() -> None:
    legs = ("RF", "RH", "LF", "LH")
    feet = replace(
        GOOD,
        stride_length_mm=71.24,
        touch_downs_per_stride=1.26,
        touch_downs_by_leg=dict(zip(legs, (1.0, 2.0, 1.0, 1.04), strict=True)),
        slip_share=dict(zip(legs, (0.116, None, 0.0, 0.35), strict=True)),
    )
    table = {name: value for name, value, _ in rows(feet)}
    assert table["Stride length"] == "71.2\xa0mm"
    assert table["Touch-downs per stride"] == (
        "RF\xa01.00, RH\xa02.00, LF\xa01.00, LH\xa01.04; mean 1.26"
    )
    assert table["Slip share"] == "RF\xa012, RH\xa0–, LF\xa00, LH\xa035"


def test_target_gait_has_its_name() -> None:
    six: WalkFeatures = walk_features(synthetic_record(5.0, TRIPOD))
    assert verdicts(six, 5.0)[1].question == "Did the tripod form?"
    assert "Tripod, strict" in [name for name, _, _ in rows(six)]


def test_heading_says_robot_and_mi_and_what_is_not_default() -> None:
    assert heading(Experiment(mi=0.08)) == "lilibot, MI 0.08"
    experiment = Experiment(
        robot="hexapod",
        preset="paper",
        mi=((0.0, 0.15), (25.0, 0.4)),
        conditions="C4",
        ground=Obstacles(roughness=0.5),
        settings={"xi": 0.05},
        rate=50.0,
    )
    expected = (
        "hexapod, MI 0:0.15,25:0.4, preset paper, obstacles:roughness=0.5, C4, rate 50 Hz, xi 0.05"
    )
    assert heading(experiment) == expected
    damaged = Conditions(damaged=("RF",), payload=0.5)
    said = heading(Experiment(mi=0.08, conditions=damaged))
    assert said == "lilibot, MI 0.08, payload 0.5, damaged RF"


def test_facts_name_robot_preset_condition_ground_parameters_and_memory() -> None:
    record = synthetic_record(0.1)
    experiment = replace(
        record.experiment,
        conditions="C4",
        ground=Obstacles(roughness=0.5),
        settings={"xi": 0.05, "stored": True, "phi_stored": (3.0, 3.0, 0.0)},
    )
    found = dict(facts(replace(record, experiment=experiment)))
    assert found["Robot"] == "lilibot, 2.50 kg, legs RF, RH, LF, LH"
    assert found["Controller"] == "apnc, preset robot, 60 Hz"
    assert found["Changed parameters"] == "xi 0.05, stored True"
    assert found["Stored gait"] == "φ 3 3 0 rad at the start"
    assert found["Conditions"] == "C4"
    assert found["Ground"] == "obstacles:roughness=0.5"
    assert dict(facts(record))["Stored gait"] == "none at the start"
