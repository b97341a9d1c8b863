"""What is measured of made-up runs, figure by figure, for every way in which a run can end."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from records import (
    HEXAPOD,
    MASS,
    OCTOPOD,
    QUADRUPED,
    RATE,
    TRIPOD,
    TROT,
    End,
    Record,
    outputs,
    synthetic_record,
)

from apnc import metrics
from apnc.features import WalkFeatures, walk_features
from apnc_core import __version__

PI = np.pi
pytestmark = pytest.mark.filterwarnings("error")


def with_signals(record: Record, **signals: np.ndarray) -> Record:
    """The record with other signals."""
    return replace(record, signals={**record.signals, **signals})


def moving_on(record: Record, forward: np.ndarray, left: np.ndarray, yaw: np.ndarray) -> Record:
    """The record with another path of the trunk."""
    position, rpy = record.signals["position"].copy(), record.signals["rpy"].copy()
    position[:, 0], position[:, 1], rpy[:, 2] = forward, left, yaw
    return with_signals(record, position=position, rpy=rpy)


def ended(record: Record, end: End, message: str = "") -> Record:
    return replace(record, end=end, message=message)


def figures(summary: WalkFeatures) -> dict[str, Any]:
    """What was measured of the gait and the motion."""
    asked = {
        "controller",
        "mi",
        "seed",
        "end",
        "message",
        "duration_s",
        "complete",
        "fell",
        "version",
    }
    asked |= {"phi_target", "real_time_factor", "fmu_share_of_wall_time", "converged"}
    return {name: value for name, value in summary.to_dict().items() if name not in asked}


def is_empty(value: Any) -> bool:
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, tuple) else ()
    return all(part is None for part in parts) if parts else value is None


def test_a_known_walk() -> None:
    walk = synthetic_record(45.0, duty=0.6, speed=0.08, frequency=1.5, yaw=0.4)
    experiment = replace(walk.experiment, mi=0.15, seed=3, controller="tegotae")
    s = walk_features(replace(walk, experiment=experiment))
    assert (s.controller, s.mi, s.seed, s.version) == ("tegotae", 0.15, 3, __version__)
    assert (s.end, s.message, s.complete, s.fell) == ("complete", "", True, False)
    assert s.duration_s == 45.0
    assert s.path_speed_m_per_s == pytest.approx(0.08)
    assert s.speed_m_per_s == pytest.approx(0.08)
    assert s.late_speed_m_per_s == pytest.approx(0.08)
    assert s.turned_deg == pytest.approx(0.0)
    assert s.distance_m == pytest.approx(0.08 * (45.0 - 1 / RATE))
    assert s.stride_frequency_hz == pytest.approx(1.5)
    assert s.stride_length_mm == pytest.approx(80.0 / 1.5)
    assert tuple(s.duty_factor) == tuple(s.foot_lift_mm) == tuple(s.slip_per_stride_mm) == QUADRUPED
    # A half-sine load is above a tenth of its peak for 1 - 2 asin(0.1) / pi of the contact.
    contact = 0.6 * (1 - 2 * np.arcsin(0.1) / PI)
    assert list(s.duty_factor.values()) == pytest.approx([contact] * 4, abs=0.03)
    assert s.duty_factor_mean == pytest.approx(np.mean(list(s.duty_factor.values())))
    assert s.touch_downs_per_stride == pytest.approx(1.0, abs=0.02)
    assert list(s.touch_downs_by_leg) == list(s.slip_share) == list(QUADRUPED)
    assert list(s.foot_lift_mm.values()) == pytest.approx([15.0] * 4, abs=0.1)
    assert list(s.slip_per_stride_mm.values()) == pytest.approx([0.0] * 4, abs=1e-6)
    assert list(s.slip_share.values()) == pytest.approx([0.0] * 4, abs=1e-6)
    assert s.balance == pytest.approx(np.sqrt(2) * (50 + 100), rel=0.01)
    assert s.converged is True and s.gait == "trot"
    assert s.convergence_time_s == s.convergence_time_authors_s == 0.0
    assert s.phi_target == TROT
    assert s.phi_final == pytest.approx(TROT, abs=1e-6)
    assert s.largest_late_error_rad == pytest.approx(0.0, abs=1e-6)
    # d = 2 exp(-t / 4) falls below 0.4, where kappa is 1, at 4 ln 5.
    assert s.stored_at_s == pytest.approx(4 * np.log(5), abs=1 / RATE)
    assert s.real_time_factor == pytest.approx(10.0)
    assert s.fmu_share_of_wall_time == pytest.approx(0.05)
    assert walk_features(replace(walk, wall_s=0.5)).real_time_factor == pytest.approx(90.0)


def test_every_figure_is_in_the_dictionary_and_in_json() -> None:
    s = walk_features(synthetic_record(5.0))
    assert list(s.to_dict()) == [field.name for field in fields(WalkFeatures)]
    loaded = json.loads(s.to_json())
    assert list(loaded) == list(s.to_dict())
    assert loaded["duty_factor"] == s.duty_factor and loaded["phi_final"] == list(s.phi_final)
    assert s.to_json().startswith('{\n  "controller"') and s.to_json().endswith("}\n")


def test_the_path_is_the_headline() -> None:
    names = [field.name for field in fields(WalkFeatures)]
    order = ["path_speed_m_per_s", "turned_deg", "speed_m_per_s", "distance_m"]
    assert names.index(order[0]) < names.index("speed_m_per_s")
    assert [name for name in names if name in order] == order


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_curve(side: float) -> None:
    walk = synthetic_record(20.0)
    angle = 1.25 * 2 * PI * walk.time / walk.time[-1]
    forward, left = 0.2 * np.sin(angle), side * 0.2 * (1 - np.cos(angle))
    s = walk_features(moving_on(walk, forward, left, metrics.wrap(side * angle)))
    assert s.turned_deg == pytest.approx(side * 450.0)
    ends = (s.rightmost_heading_deg, s.leftmost_heading_deg)
    assert ends == pytest.approx((0.0, 450.0) if side > 0 else (-450.0, 0.0))
    way = 1.25 * 2 * PI * 0.2 / walk.time[-1]
    assert s.path_speed_m_per_s == pytest.approx(way, rel=0.03)
    assert s.distance_m == pytest.approx(0.2)
    assert s.speed_m_per_s == pytest.approx(0.2 / walk.time[-1])
    assert s.late_speed_m_per_s == pytest.approx(way, rel=0.03)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_forward_is_along_the_present_heading(side: float) -> None:
    walk = synthetic_record(20.0)
    angle = 1.25 * 2 * PI * walk.time / walk.time[-1]
    forward, left = 0.2 * np.sin(angle), 0.2 * (1 - np.cos(angle))
    # backwards, the trunk looks against its path
    yaw = metrics.wrap(angle if side > 0 else angle + PI)
    s = walk_features(moving_on(walk, forward, left, yaw))
    way = 1.25 * 2 * PI * 0.2 / walk.time[-1]
    assert s.forward_speed_m_per_s == pytest.approx(side * way, rel=0.03)


def test_foot_lift_as_a_share_of_the_leg() -> None:
    s = walk_features(synthetic_record(10.0))
    for leg, lift in s.foot_lift_mm.items():
        assert s.foot_lift_share[leg] == pytest.approx(lift / 155.0)  # 70 mm femur, 85 mm tibia


def test_cost_of_transport() -> None:
    walk = synthetic_record(20.0, speed=0.1)
    power = np.arange(12).reshape(4, 3)  # 66 W in all
    work = 7.0 + walk.time[:, None, None] * power
    s = walk_features(with_signals(walk, joint_work=work))
    assert s.cost_of_transport == pytest.approx(66.0 / (MASS * 9.81 * 0.1))


def test_cost_of_transport_is_over_the_path_not_the_way_ahead() -> None:
    walk = synthetic_record(20.0)
    power = np.full((4, 3), 0.5)
    work = walk.time[:, None, None] * power
    angle = 2.0 * PI * walk.time / walk.time[-1]  # once round a circle of 0.4 m, back to its start
    forward, left = 0.4 * np.sin(angle), 0.4 * (1.0 - np.cos(angle))
    round_trip = moving_on(walk, forward, left, metrics.wrap(angle))
    s = walk_features(with_signals(round_trip, joint_work=work))
    assert s.distance_m == pytest.approx(0.0, abs=1e-9)
    spent, path = power.sum() * walk.time[-1], 2.0 * PI * 0.4
    assert s.cost_of_transport == pytest.approx(spent / (MASS * 9.81 * path), rel=0.03)


def test_late_figures_are_of_the_last_ten_seconds() -> None:
    walk = synthetic_record(30.0, speed=0.1, formation=(2.0, 5.0))
    late = np.maximum(walk.time - walk.time[-1] + 10.0, 0.0)
    moved = moving_on(walk, 0.1 * walk.time + 0.05 * late, 0 * late, 0 * late)
    s = walk_features(moved)
    assert s.late_speed_m_per_s == pytest.approx(0.15, abs=0.002)
    assert s.largest_late_error_rad == pytest.approx(0.0, abs=1e-6)
    assert walk_features(synthetic_record(14.0, formation=(2.0, 5.0))).largest_late_error_rad == (
        pytest.approx(PI - PI * (3.98 - 2.0) / 3, abs=0.05)
    )


def test_the_last_ten_seconds_begin_with_a_sample() -> None:
    walk = synthetic_record(2.0, formation=(0.0, 3.0))  # 120 samples, taken as those of 30 s
    t = np.arange(120) / 4
    slow = replace(walk, time=t, experiment=replace(walk.experiment, rate=4.0))
    s = walk_features(moving_on(slow, 0.005 * t**2, 0 * t, 0 * t))
    late = t[-41:]
    # The speed is 0.01 t, but a difference to one side at the last sample.
    assert s.late_speed_m_per_s == pytest.approx(0.01 * (late.mean() - 0.125 / 41))
    # The lead grows by pi / 180 from sample to sample.
    assert s.largest_late_error_rad == pytest.approx(PI * (1 - late[0] / 45), abs=PI / 360)


def test_each_criterion_has_its_own_figure() -> None:
    s = walk_features(synthetic_record(20.0, formation=(2.0, 12.0)))
    assert s.convergence_time_s == pytest.approx(2 + 10 * (PI - 0.6) / PI, abs=0.1)
    assert s.convergence_time_authors_s == pytest.approx(
        2 + 10 * (PI - 2.8 / np.sqrt(2)) / PI, abs=0.1
    )
    assert s.converged is True
    # Distance to (pi, pi, 0) is 2.1 rad, below 2.8, although no pair of legs is in trot.
    near = walk_features(synthetic_record(20.0, (PI - 1.2, PI - 1.2, 1.2)))
    assert near.convergence_time_authors_s == 0.0
    assert (near.converged, near.convergence_time_s, near.gait) == (False, None, None)
    assert near.largest_late_error_rad == pytest.approx(1.2)


def test_times_count_from_the_touch_moment() -> None:
    walk = synthetic_record(20.0, formation=(2.0, 12.0), air_time=4.0)
    s, at_once = walk_features(walk), walk_features(synthetic_record(20.0, formation=(2.0, 12.0)))
    late = walk.time[metrics.touch_moment(walk.signals["foot_force"][..., 2], MASS * 9.81) or 0]
    assert late == pytest.approx(4.0, abs=0.4)
    for name in ("convergence_time_s", "convergence_time_authors_s"):
        assert getattr(s, name) == pytest.approx(getattr(at_once, name) - late, abs=1.5 / RATE)


def test_what_is_before_the_touch_moment_counts_for_nothing_else() -> None:
    clean, walk = (synthetic_record(20.0, air_time=air) for air in (0.0, 4.0))
    flying = walk.time < 4.0
    theta = 2 * PI * 5.0 * walk.time[:, None] + np.zeros(4)
    o1, o2 = (
        np.where(flying[:, None], a, walk.signals[n])
        for n, a in zip(("o1", "o2"), outputs(theta), strict=True)
    )
    rpy, feet = walk.signals["rpy"].copy(), walk.signals["foot_position"].copy()
    rpy[flying, :2] += 1.0
    feet[flying] *= 50.0
    place = walk.signals["position"] * np.where(flying, 50.0, 1.0)[:, None]
    falling = with_signals(walk, o1=o1, o2=o2, rpy=rpy, foot_position=feet, position=place)
    s, without = walk_features(falling), walk_features(clean)
    assert s.stride_frequency_hz == pytest.approx(without.stride_frequency_hz)
    assert s.stride_length_mm == pytest.approx(without.stride_length_mm)
    assert s.balance == pytest.approx(without.balance, rel=0.02)
    for name in ("duty_factor", "foot_lift_mm", "slip_per_stride_mm"):
        expected = list(getattr(without, name).values())
        assert list(getattr(s, name).values()) == pytest.approx(expected, abs=0.05)
    assert s.touch_downs_per_stride == pytest.approx(1.0, abs=0.05)


def test_a_robot_that_never_touches_the_ground() -> None:
    s = walk_features(synthetic_record(5.0, air_time=9.0))
    assert (s.converged, s.convergence_time_s, s.convergence_time_authors_s) == (False, None, None)
    assert s.duty_factor_mean == 0.0 and s.foot_lift_mm == dict.fromkeys(QUADRUPED)


def test_coordination_is_of_the_worst_leg() -> None:
    walk = synthetic_record(31.0, frequency=1.0, duty=0.5)  # 30 whole strides
    force = walk.signals["foot_force"].copy()
    theta = 2 * PI * walk.time
    # Every second cycle of RF, from mid-swing to mid-swing, has no stance.
    cycle = np.floor((theta + PI / 2) / (2 * PI))
    force[cycle % 2 == 1, 0, 2] = 0.0
    force[:, 1:, 2] = force[:, 2:3, 2]
    s = walk_features(with_signals(walk, foot_force=force))
    share = 2 * (s.duty_factor["RF"] or 0.0)
    assert share == pytest.approx(0.5 * (1 - 2 * np.arcsin(0.1) / PI), abs=0.03)
    assert s.coordination == pytest.approx(2 / share, rel=0.03)
    assert list(s.touch_downs_by_leg.values()) == pytest.approx([0.5, 1.0, 1.0, 1.0], abs=0.03)
    assert s.touch_downs_per_stride == pytest.approx((0.5 + 3) / 4, abs=0.03)


def test_figures_per_leg_belong_to_their_leg() -> None:
    walk = synthetic_record(20.0)
    n = np.arange(4)
    feet, force = walk.signals["foot_position"].copy(), walk.signals["foot_force"].copy()
    feet[..., 2] *= n
    feet[..., 1] += 0.01 * n * walk.time[:, None]
    force[::2, 3, 2] = 0.0
    varied = with_signals(walk, foot_position=feet, foot_force=force)
    s = walk_features(varied)
    assert list(s.foot_lift_mm) == list(QUADRUPED)
    assert list(s.foot_lift_mm.values())[:3] == pytest.approx([0.0, 15.0, 30.0], abs=0.2)
    slip = list(s.slip_per_stride_mm.values())
    assert slip[2] == pytest.approx(2 * (slip[1] or 0.0), rel=0.05) and (slip[1] or 0) > 3.0
    assert slip[0] == pytest.approx(0.0, abs=1e-6)
    stride = 80.0 / 1.4
    assert list(s.slip_share.values()) == pytest.approx([(way or 0.0) / stride for way in slip])
    begin = metrics.touch_moment(force[..., 2], MASS * 9.81) or 0
    starts = metrics.cycle_starts(*(varied.signals[name][begin:] for name in ("o1", "o2")))
    measured = feet[begin:], metrics.stance(force[..., 2])[begin:], starts
    assert slip == pytest.approx([1000 * (value or 0.0) for value in metrics.slips(*measured)])
    assert list(s.foot_lift_mm.values()) == pytest.approx(
        [1000 * (value or 0.0) for value in metrics.foot_lifts(*measured)]
    )


def test_a_robot_that_stands_has_neither_balance_nor_coordination() -> None:
    walk = synthetic_record(20.0, speed=0.0)
    s = walk_features(walk)
    assert s.path_speed_m_per_s == pytest.approx(0.0, abs=1e-6)
    assert (s.balance, s.coordination, s.cost_of_transport) == (None, None, None)
    assert s.stride_length_mm is None and s.slip_share == dict.fromkeys(QUADRUPED)
    assert s.slip_per_stride_mm["RF"] is not None
    slow = walk_features(synthetic_record(20.0, speed=0.0051))
    assert slow.balance is not None and slow.cost_of_transport is not None
    assert slow.stride_length_mm == pytest.approx(5.1 / 1.4)


@pytest.mark.parametrize(
    ("legs", "target", "name"),
    [
        (HEXAPOD, TRIPOD, "tripod"),
        (OCTOPOD, metrics.default_target(8), "alternating tetrapod"),
    ],
)
def test_other_numbers_of_legs(legs: tuple[str, ...], target: tuple[float, ...], name: str) -> None:
    s = walk_features(synthetic_record(10.0, target))
    assert s.converged and s.gait == name and s.phi_target == target
    assert tuple(s.duty_factor) == legs and len(s.phi_final) == len(legs) - 1
    wrong = walk_features(synthetic_record(10.0, (0.0,) * len(target)))
    assert wrong.converged is False and wrong.gait == "pronk"


def test_legs_without_a_known_gait() -> None:
    walk = synthetic_record(10.0)
    signals = {k: v[:, :3] if v.ndim > 1 else v for k, v in walk.signals.items()}
    s = walk_features(replace(walk, legs=("RF", "RH", "L"), signals=signals))
    assert (s.converged, s.phi_target, s.gait) == (None, None, None)
    assert (s.convergence_time_s, s.convergence_time_authors_s) == (None, None)
    assert s.largest_late_error_rad is None
    assert s.phi_final == pytest.approx(TROT[:2]) and tuple(s.duty_factor) == ("RF", "RH", "L")


def test_a_fall_is_no_convergence_but_a_walk_until_then() -> None:
    s = walk_features(ended(synthetic_record(12.5), End.fell, "at 12.50 s"))
    assert (s.end, s.fell, s.complete, s.message) == ("fell", True, False, "at 12.50 s")
    assert (s.converged, s.convergence_time_s, s.convergence_time_authors_s) == (False, None, None)
    assert s.duration_s == 12.5
    assert s.path_speed_m_per_s == pytest.approx(0.08)
    assert s.stride_frequency_hz == pytest.approx(1.4)


def test_nothing_is_measured_of_a_diverged_run() -> None:
    walk = synthetic_record(12.5)
    thrown = with_signals(walk, position=1e45 * walk.signals["position"])
    s = walk_features(ended(thrown, End.diverged, "velocity beyond 100 m/s"))
    assert (s.end, s.fell, s.complete) == ("diverged", False, False)
    assert (s.message, s.duration_s, s.converged) == ("velocity beyond 100 m/s", 12.5, False)
    assert {name for name, value in figures(s).items() if not is_empty(value)} == set()
    assert s.duty_factor == dict.fromkeys(QUADRUPED) and s.phi_final == (None,) * 3
    assert s.real_time_factor == pytest.approx(10.0) and s.phi_target == TROT


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("signal", ["position", "foot_force", "joint_work", "o1", "o2"])
def test_nothing_is_measured_of_values_that_are_not_finite(signal: str, value: float) -> None:
    walk = synthetic_record(5.0)
    broken = walk.signals[signal].copy()
    broken.flat[100] = value
    s = walk_features(with_signals(walk, **{signal: broken}))
    assert {name for name, entry in figures(s).items() if not is_empty(entry)} == set()


def test_no_figure_is_infinite() -> None:
    walk = synthetic_record(5.0)
    thrown = with_signals(walk, position=1e200 * walk.signals["position"])
    with np.errstate(all="ignore"):
        s = walk_features(thrown)
    assert s.path_speed_m_per_s is None
    json.loads(s.to_json(), parse_constant=pytest.fail)


@pytest.mark.parametrize("samples", [0, 1, 2, 10, 100])
def test_an_interrupted_run_of_any_length(samples: int) -> None:
    s = walk_features(synthetic_record(samples / RATE, complete=False, speed=0.0))
    loaded = json.loads(s.to_json(), parse_constant=pytest.fail)
    assert (loaded["end"], loaded["complete"], loaded["fell"]) == ("interrupted", False, False)
    assert loaded["duration_s"] == pytest.approx(samples / RATE)
    assert loaded["cost_of_transport"] is None
    assert loaded["converged"] is (None if samples == 0 else samples == 100)


def test_zero_ticks_have_no_figures() -> None:
    s = walk_features(replace(synthetic_record(0.0, complete=False), wall_s=0.0))
    assert {name for name, value in figures(s).items() if not is_empty(value)} == set()
    assert (s.duration_s, s.converged, s.phi_target) == (0.0, None, TROT)
    assert (s.real_time_factor, s.fmu_share_of_wall_time) == (None, None)


def test_durations_are_round() -> None:
    assert walk_features(synthetic_record(600.0)).duration_s == 600.0


def test_rate_of_the_experiment_is_that_of_the_samples() -> None:
    walk = synthetic_record(10.0, formation=(0.0, 12.0))
    slower = replace(walk, time=2 * walk.time, experiment=replace(walk.experiment, rate=RATE / 2))
    s = walk_features(slower)
    # Two of four legs gain half a turn in 24 s.
    assert s.stride_frequency_hz == pytest.approx(0.7 + 0.5 / 48)
    # The mean over the last second is that of the last 30 samples.
    assert s.phi_final[0] == pytest.approx(PI * 9.75 / 12, abs=0.01)
    assert s.phi_final[2] == pytest.approx(0.0)


def test_steps_of_a_command_are_kept() -> None:
    walk = synthetic_record(5.0)
    steps = ((0.0, 0.08), (2.0, 0.15))
    s = walk_features(replace(walk, experiment=replace(walk.experiment, mi=steps)))
    assert s.mi == steps


@pytest.mark.parametrize(("duration", "measured"), [(1.0, False), (6.0, True)])
def test_a_fall_at_once_is_no_walk_to_measure(duration: float, measured: bool) -> None:
    record = replace(synthetic_record(duration), end=End.fell)
    summary = walk_features(record)
    assert summary.fell and not summary.converged
    assert (summary.path_speed_m_per_s is not None) is measured
    assert (summary.balance is not None) is measured


@pytest.mark.parametrize(
    "laid_out", [np.asfortranarray, lambda values: np.stack([values] * 8, axis=-1)[..., 3]]
)
def test_signals_may_lie_in_memory_in_any_order(
    laid_out: Callable[[np.ndarray], np.ndarray],
) -> None:
    walk = synthetic_record(10.0, formation=(1.0, 3.0))
    signals = {name: laid_out(v) for name, v in walk.signals.items()}
    assert not signals["o1"].flags.c_contiguous
    assert walk_features(with_signals(walk, **signals)) == walk_features(walk)
