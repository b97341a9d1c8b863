"""Every metric against signals whose answer is known in closed form."""

from __future__ import annotations

import json

import numpy as np
import pytest
from records import HEXAPOD, QUADRUPED, RATE, TRIPOD, TROT, synthetic_record

from apnc import metrics
from apnc.summary import summarise

PI = np.pi
WEIGHT = 2.5 * 9.81


def oscillator(mi: float, ticks: int = 600) -> tuple[np.ndarray, np.ndarray]:
    """The SO(2) oscillator of Eq. 1-3 itself, so that the sense of rotation is not assumed."""
    a = np.array([0.0, 0.1])
    w12 = 0.21 + mi
    weights = np.array([[1.4, w12], [-w12, 1.4]])
    history = np.empty((ticks, 2))
    for n in range(ticks):
        o = np.tanh(a)
        history[n] = o
        a = weights @ o
    return history[:, 0], history[:, 1]


def delayed_pair(lag: int) -> tuple[np.ndarray, np.ndarray]:
    """Leg 1, and a second leg that does the same ``lag`` ticks later."""
    o1, o2 = oscillator(0.08)
    start = 200
    here, there = slice(start, None), slice(start - lag, -lag or None)
    return np.stack([o1[here], o1[there]], axis=1), np.stack([o2[here], o2[there]], axis=1)


def steady(phases: tuple[float, ...], seconds: float = 10.0) -> tuple[np.ndarray, ...]:
    t = np.arange(round(seconds * RATE)) / RATE
    theta = 2 * PI * 1.4 * t[:, None] + np.array([0.0, *phases])
    return t, np.cos(theta), -np.sin(theta)


def test_cpg_phase_grows_with_time_on_the_real_oscillator() -> None:
    o1, o2 = oscillator(0.08)
    phase = np.unwrap(metrics.cpg_phase(o1, o2)[100:])
    assert np.all(np.diff(phase) > 0)


@pytest.mark.parametrize("lag", [5, 10, 14])
def test_relative_phase_has_the_sign_of_eq_12(lag: int) -> None:
    o1, o2 = delayed_pair(lag)
    phase = metrics.relative_phases(o1, o2)[:, 0]
    time = np.arange(len(o1)) / RATE
    from_peaks = metrics.phase_from_peaks(time, o1[:, 0], o1[:, 1])
    assert from_peaks is not None
    # A leg that lags peaks later, so t_p^1 - t_p^2 and with it phi_12 are negative.
    assert from_peaks < 0 and np.all(phase < 0)
    assert abs(phase[len(phase) // 2] - from_peaks) < 0.25


@pytest.mark.parametrize("phi", [-2.0, 0.0, 0.5, PI - 0.01, -PI + 0.01])
def test_relative_phase_of_circles_is_exact(phi: float) -> None:
    _, o1, o2 = steady((phi,))
    assert metrics.wrap(metrics.relative_phases(o1, o2) - phi) == pytest.approx(0.0, abs=1e-9)


def test_smoothing_does_not_average_across_the_cut() -> None:
    t = np.arange(600) / RATE
    # Swings by 0.2 rad about pi: a mean of wrapped angles would be near 0.
    lead = PI + 0.2 * np.sin(2 * PI * 5 * t)
    o1, o2 = np.cos([0 * t, lead]).T, -np.sin([0 * t, lead]).T
    error = np.abs(metrics.wrap(metrics.relative_phases(o1, o2)[:, 0] - PI))
    assert error[60:-60].max() < 0.03


def test_final_phases_are_shown_away_from_the_cut() -> None:
    _, o1, o2 = steady((PI + 0.1, -PI + 0.1, -0.1))
    final = metrics.final_phases(o1, o2, 1 / RATE)
    assert final == pytest.approx([PI + 0.1, PI + 0.1, -0.1], abs=1e-9)


def test_phase_of_a_resting_cpg_is_undefined() -> None:
    zero = np.zeros((200, 4))
    assert np.isnan(metrics.relative_phases(zero, zero)).all()


@pytest.mark.parametrize(
    ("phi", "expected"), [(0.5, 0.5), (-0.5, 0.5), (PI, PI), (5.0, 2 * PI - 5)]
)
def test_authors_difference_has_no_sign(phi: float, expected: float) -> None:
    _, o1, o2 = steady((phi,))
    assert metrics.phase_difference_authors(o1, o2) == pytest.approx(expected, abs=1e-6)


def test_touch_moment_needs_two_feet() -> None:
    force = np.zeros((5, 4))
    force[1, 0] = force[2, :2] = WEIGHT / 5
    force[3, 0] = force[4, :2] = WEIGHT / 5 + 0.01
    assert metrics.touch_moment(force, WEIGHT) == 4
    assert metrics.touch_moment(force[:4], WEIGHT) is None


def test_trot_from_the_start_converges_at_once() -> None:
    t, o1, o2 = steady(TROT)
    assert metrics.convergence_time(t, o1, o2, 30, TROT) == 0.0
    assert metrics.convergence_time_authors(t, o1, o2, 30, TROT) == 0.0


@pytest.mark.parametrize("phases", [(0, 0, 0), (PI, PI, 0.7), (PI, PI - 0.7, 0), (0, PI, PI)])
def test_other_gaits_are_not_a_trot(phases: tuple[float, ...]) -> None:
    t, o1, o2 = steady(phases)
    assert metrics.convergence_time(t, o1, o2, 0, TROT) is None


def test_authors_criterion_accepts_what_the_strict_one_rejects() -> None:
    # Distance to (pi, pi, 0) is 2.1 rad, below 2.8, although no leg pair is in trot.
    t, o1, o2 = steady((PI - 1.2, PI - 1.2, 1.2))
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) == 0.0
    assert metrics.convergence_time(t, o1, o2, 0, TROT) is None


def test_in_phase_does_not_meet_the_authors_criterion() -> None:
    t, o1, o2 = steady((0.0, 0.0, 0.0))
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) is None


def test_convergence_times_of_a_ramp() -> None:
    r = synthetic_record(20.0, formation=(2.0, 12.0))
    o1, o2 = r.controller["o1"], r.controller["o2"]
    # phi13 enters the band at pi - 0.6; the distance sqrt(2) (pi - x) is 2.8 at x = pi - 1.98.
    strict = metrics.convergence_time(r.time, o1, o2, 60, TROT)
    authors = metrics.convergence_time_authors(r.time, o1, o2, 60, TROT)
    assert strict == pytest.approx(2 + 10 * (PI - 0.6) / PI - 1.0, abs=0.1)
    assert authors == pytest.approx(2 + 10 * (PI - 2.8 / np.sqrt(2)) / PI - 1.0, abs=0.1)


def test_a_trot_that_is_lost_again_does_not_count() -> None:
    t, o1, o2 = steady(TROT, 20.0)
    _, p1, p2 = steady((PI, PI, 1.5), 20.0)
    late = t > 15
    o1[late], o2[late] = p1[late], p2[late]
    assert metrics.convergence_time(t, o1, o2, 0, TROT) is None
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) == 0.0


def test_a_trot_in_the_last_moment_does_not_count() -> None:
    r = synthetic_record(10.0, formation=(9.0, 9.3))
    o1, o2 = r.controller["o1"], r.controller["o2"]
    assert metrics.convergence_time(r.time, o1, o2, 0, TROT) is None


def test_never_on_the_ground_never_converged() -> None:
    t, o1, o2 = steady(TROT)
    assert metrics.convergence_time(t, o1, o2, None, TROT) is None
    assert metrics.convergence_time_authors(t, o1, o2, None, TROT) is None


def test_target_of_the_wrong_length_is_refused() -> None:
    t, o1, o2 = steady(TROT)
    with pytest.raises(ValueError, match="3 relative phases"):
        metrics.convergence_time(t, o1, o2, 0, TRIPOD)


def square(period: int, on: int, strides: int) -> np.ndarray:
    return np.tile(np.arange(period) < on, strides)


def test_duty_factor_and_frequency_of_a_square_wave() -> None:
    standing = np.stack([square(40, 24, 10), square(40, 10, 10)], axis=1)
    assert metrics.duty_factors(standing) == pytest.approx([0.6, 0.25])
    assert metrics.stride_frequency(standing, 1 / RATE) == pytest.approx(1.5)


def test_leg_without_a_stride_has_no_duty_factor() -> None:
    standing = np.stack([np.ones(100, bool), np.zeros(100, bool)], axis=1)
    assert metrics.duty_factors(standing) == [None, None]
    assert metrics.stride_frequency(standing, 1 / RATE) is None
    assert metrics.coordination(standing) is None


def test_stance_is_a_tenth_of_the_largest_force_of_leg_one() -> None:
    force = np.zeros((60, 2))
    force[20:40] = [10.0, 0.9]
    assert metrics.stance(force).sum(axis=0).tolist() == [20, 0]
    force[20:40, 1] = 1.1
    assert metrics.stance(force).sum(axis=0).tolist() == [20, 20]


def test_one_impact_does_not_hide_the_stance() -> None:
    force = np.where(square(40, 24, 10), 10.0, 0.0)[:, None]
    force[200] = 500.0
    assert metrics.duty_factors(metrics.stance(force)) == pytest.approx([0.6])
    # The authors' letter: threshold at 50 N, and every ordinary stance is gone.
    assert metrics.stance(force, quantile=1.0, min_run=1).sum() == 1


def test_flicker_makes_no_strides() -> None:
    force = np.where(square(40, 24, 10), 10.0, 0.0)[:, None]
    force[10::40] = 0.0
    force[30::40] = 10.0
    assert metrics.duty_factors(metrics.stance(force)) == pytest.approx([0.6])


def test_coordination_is_the_inverse_of_the_worst_spread() -> None:
    even = square(40, 20, 9)
    # Strides of duty 0.4 and 0.6 in turn: standard deviation 0.1.
    uneven = np.concatenate([square(40, 16 + 8 * (i % 2), 1) for i in range(9)])
    # The first touch-down is cut off at the start, so eight strides start at 0.6, 0.4, ...
    standing = np.stack([even, uneven], axis=1)
    duty = metrics.stride_duty(uneven)
    assert set(duty.round(9)) == {0.4, 0.6}
    share = np.mean(duty > 0.5)
    assert metrics.coordination(standing) == pytest.approx(1 / (0.2 * np.sqrt(share * (1 - share))))
    assert metrics.coordination(np.stack([even, even], axis=1)) is None


def test_balance_of_sines() -> None:
    t = np.arange(600) / 60
    roll, pitch = 0.02 * np.sin(2 * PI * t), 0.01 * np.sin(4 * PI * t)
    assert metrics.balance(roll, pitch) == pytest.approx(np.sqrt(2) * (50 + 100))
    assert metrics.balance(roll, 0 * pitch) is None


def test_speed_is_along_the_initial_heading() -> None:
    t = np.arange(601) / 60
    position = np.column_stack([0.3 * t, 0.4 * t, 0 * t])
    ahead, aside = np.arctan2(4, 3), 0.0
    assert metrics.forward_speed(t, position, np.full(601, ahead)) == pytest.approx(0.5)
    assert metrics.forward_speed(t, position, np.full(601, aside)) == pytest.approx(0.3)
    assert metrics.forward_speed(t, position, np.full(601, ahead + PI)) == pytest.approx(-0.5)
    assert metrics.path_speed(t, position) == pytest.approx(0.5)


def test_sway_is_no_distance() -> None:
    t = np.arange(1201) / 60
    position = np.column_stack([0.1 * t, 0.01 * np.sin(2 * PI * 2 * t), 0 * t])
    assert metrics.path_length(position) == pytest.approx(2.0, rel=0.02)


def test_walking_a_circle_shows_in_the_path_speed_only() -> None:
    t = np.arange(1201) / 60
    angle = 2 * PI * t / 20
    position = np.column_stack([np.sin(angle), 1 - np.cos(angle), 0 * t])
    assert metrics.forward_speed(t, position, angle) == pytest.approx(0.0, abs=1e-9)
    assert metrics.path_speed(t, position) == pytest.approx(2 * PI / 20, rel=0.01)
    assert metrics.smoothed_speed(t, position, angle)[300] == pytest.approx(2 * PI / 20, rel=0.01)


def test_cost_of_transport_of_constant_power() -> None:
    t = np.arange(601) / 60
    # 1.5 W and 0.5 W for 10 s over 2.5 kg * 9.81 m/s^2 * 4 m; what was spent before is no matter
    work = np.column_stack([1.5 * t, 0.5 * t + 3.0])
    expected = 20 / (2.5 * 9.81 * 4)
    assert metrics.cost_of_transport(t, work, 2.5, 4.0) == pytest.approx(expected)
    assert metrics.cost_of_transport(t, work, 2.5, 0.01) is None


def test_a_fall_is_tilt_or_lying_down() -> None:
    level, high = np.zeros(10), np.full(10, 0.15)
    tilted = level.copy()
    tilted[5] = np.deg2rad(61)
    assert not metrics.fell(level, level, high)
    assert not metrics.fell(tilted * 59 / 61, level, high)
    assert metrics.fell(tilted, level, high)
    assert metrics.fell(level, -tilted, high)
    assert metrics.fell(level, level, high - np.where(np.arange(10) == 7, 0.1, 0))


def test_summary_of_a_known_walk() -> None:
    record = synthetic_record(45.0, duty=0.6, speed=0.08, frequency=1.5, yaw=0.4)
    s = summarise(record, method="apnc", mi=0.08, seed=3)
    assert (s.method, s.mi, s.seed, s.complete) == ("apnc", 0.08, 3, True)
    assert s.duration_s == pytest.approx(45.0)
    assert s.speed_m_per_s == pytest.approx(0.08)
    assert s.stride_frequency_hz == pytest.approx(1.5, rel=0.01)
    assert tuple(s.duty_factor) == QUADRUPED
    # A half-sine load is above a tenth of its peak for 1 - 2 asin(0.1) / pi of the contact.
    contact = 0.6 * (1 - 2 * np.arcsin(0.1) / PI)
    assert list(s.duty_factor.values()) == pytest.approx([contact] * 4, abs=0.03)
    assert s.balance == pytest.approx(np.sqrt(2) * 150, rel=0.01)
    assert s.converged and not s.fell
    assert s.phi_final == pytest.approx(TROT, abs=1e-6)
    assert s.real_time_factor == pytest.approx(10.0)
    assert s.fmu_share_of_wall_time == pytest.approx(0.05)


def test_summary_of_a_hexapod_uses_the_tripod() -> None:
    s = summarise(synthetic_record(10.0, TRIPOD), method="apnc", mi=0.08, seed=0)
    assert s.converged and tuple(s.duty_factor) == HEXAPOD
    wrong = synthetic_record(10.0, (0.0,) * 5)
    assert summarise(wrong, method="apnc", mi=0.08, seed=0).converged is False


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("samples", [0, 1, 2, 10, 100])
def test_summary_of_an_interrupted_run_is_strict_json(samples: int) -> None:
    record = synthetic_record(samples / RATE, complete=False, speed=0.0)
    s = summarise(record, method="apnc", mi=0.08, seed=0)

    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    loaded = json.loads(s.to_json(), parse_constant=refuse)
    assert loaded["complete"] is False
    assert loaded["cost_of_transport"] is None
    assert loaded["converged"] is (samples == 100)
