"""The words of a summary: every figure under its own name."""

from __future__ import annotations

from dataclasses import replace

from records import synthetic_record

from apnc.features import WalkFeatures, walk_features
from apnc.report.wording import rows, verdicts

SHOWN = {
    "path_speed_m_per_s": ("Speed along the path", 0.123, "0.123 m/s"),
    "turned_deg": ("Turned", 12.0, "12° to the left"),
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
    figures = {name: value for name, (_, value, _) in SHOWN.items()}
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
