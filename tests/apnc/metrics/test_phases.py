"""Phases against signals whose answer is known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from records import RATE, outputs, steady

from apnc import metrics

PI = np.pi


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


def phase_from_peaks(o1_l: np.ndarray, o1_k: np.ndarray) -> float:
    """phi_lk from the last peaks of o1, Eq. 12 to the letter."""

    def peaks(s: np.ndarray) -> np.ndarray:
        return np.flatnonzero((s[1:-1] > s[:-2]) & (s[1:-1] >= s[2:]) & (s[1:-1] > 0)) + 1

    peaks_l, peaks_k = peaks(o1_l), peaks(o1_k)
    angle = 2 * PI * (peaks_l[-1] - peaks_k[-1]) / (peaks_l[-1] - peaks_l[-2])
    return float((angle + PI) % (2 * PI) - PI)


def test_cpg_phase_grows_with_time_on_the_real_oscillator() -> None:
    phase = np.unwrap(metrics.cpg_phase(*oscillator(0.08))[100:])
    assert np.all(np.diff(phase) > 0)


@pytest.mark.parametrize("drift", [0.0, PI / 2, PI, 2 * PI])
def test_coherence_is_that_of_an_even_drift(drift: float) -> None:
    t = np.arange(round(20.0 * RATE)) / RATE
    theta = 2 * PI * 1.4 * t[:, None] + np.stack([0 * t, 0 * t + 3.0, drift / 5.0 * t], axis=1)
    found = metrics.coherence(*outputs(theta), 1.0 / RATE, 5.0)
    # smoothing reaches over the end, where the drift is not even
    assert found == pytest.approx(abs(np.sinc(drift / 2 / PI)), abs=0.08)


@pytest.mark.parametrize("samples", [40, 90, 330, 400, 900])
def test_coherence_is_of_the_smoothed_phases_at_the_end(samples: int) -> None:
    steps = np.random.default_rng(0).normal(0.0, 0.4, (samples, 4))
    o1, o2 = outputs(steps.cumsum(axis=0))
    phases = metrics.relative_phases(o1, o2)[-300:]
    expected = np.abs(np.exp(1j * phases).mean(axis=0)).min()
    assert metrics.coherence(o1, o2, 1.0 / RATE, 5.0) == pytest.approx(expected, rel=1e-12)


def test_coherence_of_nothing_and_of_an_oscillator_at_rest() -> None:
    o1, o2 = outputs(np.zeros((300, 2)))
    assert metrics.coherence(o1[:0], o2[:0], 1.0 / RATE, 5.0) is None
    assert metrics.coherence(o1 * [1.0, 0.0], o2, 1.0 / RATE, 5.0) == 0.0


def test_cpg_phase_is_zero_where_o1_peaks() -> None:
    angle = np.array([0.0, 1.0, -2.0, 3.1])
    assert metrics.cpg_phase(*outputs(angle)) == pytest.approx(angle)


@pytest.mark.parametrize("lag", [5, 10, 14])
def test_relative_phase_has_the_sign_of_eq_12(lag: int) -> None:
    o1, o2 = oscillator(0.08)
    here, there = slice(200, None), slice(200 - lag, -lag)
    o1, o2 = np.stack([o1[here], o1[there]], axis=1), np.stack([o2[here], o2[there]], axis=1)
    phase = metrics.relative_phases(o1, o2)[:, 0]
    from_peaks = phase_from_peaks(o1[:, 0], o1[:, 1])
    # A leg that lags peaks later, so t_p^1 - t_p^2 and with it phi_12 are negative.
    assert from_peaks < 0 and np.all(phase < 0)
    # Peaks fall on samples: one tick of 1/60 s at 1.4 Hz is 0.15 rad.
    assert abs(phase[len(phase) // 2] - from_peaks) < 0.25


@pytest.mark.parametrize("phi", [-2.0, 0.0, 0.5, PI - 0.01, -PI + 0.01])
def test_relative_phase_of_circles_is_exact(phi: float) -> None:
    _, o1, o2 = steady((phi,))
    assert metrics.wrap(metrics.relative_phases(o1, o2) - phi) == pytest.approx(0.0, abs=1e-9)


def test_every_leg_has_its_own_phase() -> None:
    _, o1, o2 = steady((0.3, 1.0, -2.0))
    assert metrics.relative_phases(o1, o2)[300] == pytest.approx([0.3, 1.0, -2.0])
    assert metrics.phase_difference_authors(o1, o2)[300] == pytest.approx([0.3, 1.0, 2.0])
    assert metrics.final_phases(o1, o2, 1 / RATE) == pytest.approx([0.3, 1.0, -2.0 % (2 * PI)])


def test_the_amplitude_of_an_oscillator_does_not_weigh() -> None:
    _, o1, o2 = steady((0.3,))
    fading = np.stack([np.linspace(1.0, 0.1, len(o1)), np.linspace(0.2, 0.9, len(o1))], axis=1)
    assert metrics.relative_phases(fading * o1, fading * o2) == pytest.approx(0.3)
    assert metrics.phase_difference_authors(fading * o1, fading * o2) == pytest.approx(0.3)


def test_swing_within_a_cycle_is_smoothed() -> None:
    t = np.arange(600) / RATE
    # 0.2 rad about pi at 5 Hz: a mean of wrapped angles would be near 0.
    o1, o2 = outputs(np.array([0 * t, PI + 0.2 * np.sin(2 * PI * 5 * t)]).T)
    error = np.abs(metrics.wrap(metrics.relative_phases(o1, o2)[:, 0] - PI))
    assert error[60:-60].max() < 0.03


def test_final_phases_are_shown_away_from_the_cut() -> None:
    _, o1, o2 = steady((PI + 0.1, -PI + 0.1, -0.1))
    final = metrics.final_phases(o1, o2, 1 / RATE)
    assert final == pytest.approx([PI + 0.1, PI + 0.1, -0.1], abs=1e-9)


def test_final_phases_are_of_the_last_second() -> None:
    t = np.arange(600) / RATE
    # The lead grows by 0.1 rad per second, so its mean over the last second is that at 9.5 s.
    o1, o2 = outputs(np.array([0 * t, 0.1 * t]).T)
    assert metrics.final_phases(o1, o2, 1 / RATE) == pytest.approx([0.95], abs=0.001)
    # From 0.3 rad before pi to 0.3 rad behind it: a mean of wrapped angles would be near 0.
    o1, o2 = outputs(np.array([0 * t, PI + 0.6 * (t - 9.5)]).T)
    assert metrics.final_phases(o1, o2, 1 / RATE) == pytest.approx([PI], abs=0.01)
    # One sample for a tick longer than that.
    o1, o2 = outputs(np.array([0 * t, 0.1 * t]).T)
    assert metrics.final_phases(o1, o2, 5.0) == pytest.approx([0.1 * t[-1]], abs=0.0005)


def test_phase_of_a_resting_cpg_is_undefined() -> None:
    zero = np.zeros((200, 4))
    assert np.isnan(metrics.relative_phases(zero, zero)).all()
    assert np.isnan(metrics.final_phases(zero, zero, 1 / RATE)).all()
    assert metrics.phase_difference_authors(zero, zero) == pytest.approx(0.0)


def test_nothing_recorded_has_no_phase() -> None:
    none = np.zeros((0, 4))
    assert metrics.relative_phases(none, none).shape == (0, 3)
    assert np.isnan(metrics.final_phases(none, none, 1 / RATE)).tolist() == [True] * 3


@pytest.mark.parametrize(
    ("phi", "expected"), [(0.5, 0.5), (-0.5, 0.5), (PI, PI), (5.0, 2 * PI - 5)]
)
def test_authors_difference_has_no_sign(phi: float, expected: float) -> None:
    _, o1, o2 = steady((phi,))
    assert metrics.phase_difference_authors(o1, o2) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(
    ("angle", "wrapped", "shown"),
    [
        (0.0, 0.0, 0.0),
        (PI - 0.01, PI - 0.01, PI - 0.01),
        (PI + 0.01, -PI + 0.01, PI + 0.01),
        (-PI / 2 + 0.01, -PI / 2 + 0.01, -PI / 2 + 0.01),
        (-PI / 2 - 0.01, -PI / 2 - 0.01, 3 * PI / 2 - 0.01),
        (7 * PI, -PI, PI),
    ],
)
def test_wrapping(angle: float, wrapped: float, shown: float) -> None:
    assert metrics.wrap(angle) == pytest.approx(wrapped)
    assert metrics.wrap_for_display(angle) == pytest.approx(shown)
