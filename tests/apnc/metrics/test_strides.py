"""Strides from oscillators and contacts that are made to measure."""

from __future__ import annotations

import numpy as np
import pytest
from records import RATE, outputs
from scipy.ndimage import binary_opening

from apnc import metrics

PI = np.pi
PERIOD = 40  # samples


def cycles(n_legs: int = 1, strides: int = 8) -> list[np.ndarray]:
    """Starts of strides of 40 samples from mid-swing at sample 10 on, the same for every leg."""
    phase = 2 * PI * (np.arange(10 + PERIOD * strides + 20) - 9.999) / PERIOD - PI / 2
    return metrics.cycle_starts(*outputs(np.tile(phase[:, None], n_legs)))


def contacts(*spans: tuple[int, int], strides: int = 8) -> np.ndarray:
    """Stance of one foot for ``cycles``: spans [first, last) counted from mid-swing."""
    progress = (np.arange(10 + PERIOD * strides + 20) - 10) % PERIOD
    return np.logical_or.reduce([(progress >= a) & (progress < b) for a, b in spans])


def legs(*columns: np.ndarray) -> np.ndarray:
    return np.stack(columns, axis=1)


def test_cycles_begin_at_mid_swing() -> None:
    t = np.arange(600) / RATE
    f, lead = np.array([1.4, 1.1]), np.array([0.3, -2.0])
    starts = metrics.cycle_starts(*outputs(2 * PI * f * t[:, None] + lead))
    for found, frequency, phase in zip(starts, f, lead, strict=True):
        first = (1.5 * PI - phase) % (2 * PI) / (2 * PI)
        expected = RATE * np.arange(first, frequency * t[-1], 1.0) / frequency
        assert found == pytest.approx(expected)


def test_the_ends_of_a_run_count_if_they_are_at_mid_swing() -> None:
    phase = np.linspace(-PI / 2 - 1e-6, 5.5 * PI + 1e-6, 200)[:, None]
    assert metrics.cycle_starts(*outputs(phase))[0] == pytest.approx(
        199 * np.arange(4) / 3, abs=1e-4
    )
    inside = np.linspace(-PI / 2 + 1e-3, 5.5 * PI - 1e-3, 200)[:, None]
    assert len(metrics.cycle_starts(*outputs(inside))[0]) == 2


def test_an_oscillator_that_does_not_go_round_has_no_cycle() -> None:
    t = np.arange(600) / RATE
    to_and_fro = 1.5 * PI + 0.9 * PI * np.sin(2 * PI * t)
    resting = np.full_like(t, 2.0)
    starts = metrics.cycle_starts(*outputs(legs(to_and_fro, resting)))
    assert metrics.stride_frequency(starts, 1 / RATE) is None
    standing = legs(np.sin(t) > 0, t > 5)
    assert metrics.duty_factors(standing, starts) == [None, None]
    assert metrics.touch_downs_per_stride(standing, starts) == [None, None]
    assert metrics.slips(np.zeros((600, 2, 3)), standing, starts) == [None, None]
    assert metrics.foot_lifts(np.zeros((600, 2, 3)), standing, starts) == [None, None]
    assert metrics.coordination(standing, starts, 0.1) is None
    assert (
        metrics.stride_frequency(metrics.cycle_starts(0 * legs(t), 0 * legs(t)), 1 / RATE) is None
    )


def test_a_phase_that_is_set_back_passes_mid_swing_once() -> None:
    phase = 2 * PI * np.arange(300) / PERIOD
    back = phase - np.where(np.arange(300) >= 95, 1.0, 0.0)  # from 0.36 pi past mid-swing
    assert np.sum(np.diff(back) < 0) == 1
    starts = metrics.cycle_starts(*outputs(legs(back)))[0]
    assert len(starts) == 7 and np.diff(starts).min() > PERIOD - 1e-6


def test_nothing_recorded_has_no_cycle() -> None:
    starts = metrics.cycle_starts(np.zeros((0, 4)), np.zeros((0, 4)))
    assert [len(s) for s in starts] == [0] * 4
    assert metrics.foot_lifts(np.zeros((0, 4, 3)), np.zeros((0, 4), bool), starts) == [None] * 4


def test_frequency_is_the_mean_over_the_legs_that_stride() -> None:
    t = np.arange(600) / RATE
    starts = metrics.cycle_starts(*outputs(2 * PI * t[:, None] * [1.0, 2.0, 0.0]))
    assert metrics.stride_frequency(starts, 1 / RATE) == pytest.approx(1.5)
    assert metrics.stride_frequency(starts, 2 / RATE) == pytest.approx(0.75)


def test_quick_strides_at_the_start_do_not_count() -> None:
    t = np.arange(900) / RATE
    turns = np.where(t < 3, 2 * t, 6 + (t - 3))  # six turns at 2 Hz, twelve at 1 Hz
    starts = metrics.cycle_starts(*outputs(legs(2 * PI * turns)))
    assert len(starts[0]) == 18
    assert metrics.stride_frequency(starts, 1 / RATE) == pytest.approx(1.0)


def test_one_stride_is_enough_for_a_frequency() -> None:
    assert metrics.stride_frequency(cycles(strides=1), 1 / RATE) == pytest.approx(1.5)


def test_duty_factor_of_clean_steps() -> None:
    standing = legs(contacts((8, 32)), contacts((15, 25)))
    starts = cycles(2)
    assert [len(s) for s in starts] == [9, 9]
    assert metrics.duty_factors(standing, starts) == pytest.approx([0.6, 0.25])
    assert metrics.touch_downs_per_stride(standing, starts) == [1.0, 1.0]


def test_contacts_of_a_cycle_are_merged() -> None:
    standing = legs(contacts((4, 8), (14, 30)), contacts((0, 8), (14, 30)))
    starts = cycles(2)
    assert metrics.duty_factors(standing, starts) == pytest.approx([0.5, 0.6])
    assert metrics.touch_downs_per_stride(standing, starts) == [2.0, 2.0]
    assert metrics.stride_frequency(starts, 1 / RATE) == pytest.approx(1.5)


def test_only_whole_strides_count() -> None:
    standing = contacts((8, 32))
    standing[:10] = standing[10 + 8 * PERIOD :] = True
    standing[5] = standing[335] = False
    assert metrics.duty_factors(legs(standing), cycles()) == pytest.approx([0.6])
    # The touch-down at the start of the first stride is gone, since the foot stood before it.
    assert metrics.touch_downs_per_stride(legs(standing), cycles()) == [1.0]


def test_feet_that_never_lift_or_never_touch() -> None:
    standing = legs(contacts((0, PERIOD)), ~contacts((0, PERIOD)))
    assert metrics.duty_factors(standing, cycles(2)) == [1.0, 0.0]
    assert metrics.touch_downs_per_stride(standing, cycles(2)) == [0.0, 0.0]


def test_coordination_is_the_inverse_of_the_worst_spread() -> None:
    even, worse = contacts((10, 30)), contacts((12, 28))
    worse[10 + 4 * PERIOD :] = contacts((8, 32))[10 + 4 * PERIOD :]  # 0.4 four times, then 0.6
    standing = legs(even, worse)
    assert metrics.coordination(standing, cycles(2), 0.1) == pytest.approx(10.0)
    assert metrics.coordination(standing[:, ::-1], cycles(2), 0.005) == pytest.approx(10.0)
    assert metrics.coordination(legs(even, even), cycles(2), 0.1) is None
    for speed in (None, 0.0, 0.0049):
        assert metrics.coordination(standing, cycles(2), speed) is None


def test_coordination_needs_two_strides_of_every_leg() -> None:
    half = 10 + PERIOD
    standing = contacts((10, 30), strides=2)
    standing[half:] = contacts((12, 28), strides=2)[half:]
    both = legs(standing, standing)
    assert metrics.coordination(both, cycles(2, strides=2), 0.1) == pytest.approx(1 / 0.05)
    one = [cycles(strides=2)[0], cycles(strides=1)[0]]
    assert metrics.coordination(both, one, 0.1) is None


def test_foot_lift_is_above_stance_and_a_slope_cancels() -> None:
    k = np.arange(10 + PERIOD * 8 + 20)
    up = 0.015 * np.cos(2 * PI * (k - 9.999) / PERIOD).clip(0.0)
    position = np.zeros((len(k), 2, 3))
    position[:, 0, 2] = 0.012 + up
    position[:, 1, 2] = 0.5 * up + 0.001 * (k - 9.999)
    standing = legs(contacts((11, 30)), contacts((11, 30)))
    lifts = metrics.foot_lifts(position, standing, cycles(2))
    assert lifts == pytest.approx([0.015, 0.0075], abs=1e-5)


def test_a_stride_without_stance_has_no_lift() -> None:
    position = np.zeros((350, 1, 3))
    position[: 10 + PERIOD // 2, 0, 2] = 0.1  # before the middle of the first stride
    standing = contacts((15, 25))
    standing[: 10 + PERIOD] = False
    assert metrics.foot_lifts(position, legs(standing), cycles()) == pytest.approx([0.0])
    assert metrics.foot_lifts(position, legs(~standing & standing), cycles()) == [None]


def test_slip_is_the_horizontal_way_in_stance() -> None:
    k = np.arange(10 + PERIOD * 8 + 20)
    position = np.stack([0.003 * k, -0.004 * k, 0.1 * k], axis=1)[:, None]
    position = np.concatenate([position, 0 * position], axis=1)
    # 24 samples in stance are 23 steps of 5 mm.
    standing = legs(contacts((8, 32)), contacts((8, 32)))
    assert metrics.slips(position, standing, cycles(2)) == pytest.approx([0.115, 0.0])


@pytest.mark.parametrize("leg", [0, 1])
def test_stance_is_above_a_tenth_of_the_largest_force_of_leg_one(leg: int) -> None:
    force = np.zeros((60, 2))
    force[:, leg] = 1.1
    force[:, 1] = force[:, 1].clip(0.9)
    force[20:40, 0] = 10.0
    assert metrics.stance(force)[:, 0].sum() == (60 if leg == 0 else 20)
    assert metrics.stance(force)[:, 1].sum() == (0 if leg == 0 else 60)


def test_one_impact_does_not_hide_the_stance() -> None:
    force = np.where(contacts((8, 32)), 10.0, 0.0)[:, None]
    force[200] = 500.0
    assert (metrics.stance(force)[:, 0] == contacts((8, 32))).all()
    assert (metrics.stance(1e-3 * force) == metrics.stance(force)).all()


@pytest.mark.parametrize(("samples", "flicker"), [(1, True), (2, True), (3, False)])
def test_flicker_is_removed(samples: int, flicker: bool) -> None:
    step = np.arange(60)
    gap = np.where((step >= 20) & (step < 20 + samples), 0.0, 10.0)
    assert (~metrics.stance(gap[:, None])).sum() == (0 if flicker else samples)
    contact = np.where((step >= 20) & (step < 20 + samples), 10.0, 0.0)
    assert metrics.stance(legs(10.0 * (step > 50), contact))[:, 1].sum() == (
        0 if flicker else samples
    )


@pytest.mark.parametrize("samples", [1, 2, 3, 4, 5, 400])
@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_flicker_is_what_an_opening_of_three_samples_removes(samples: int, share: float) -> None:
    down = np.random.default_rng(3).random((samples, 4)) < share
    down[0, 0] = True  # the largest force of leg 1 is that of the contacts

    def opened(signals: np.ndarray) -> np.ndarray:
        longer = np.pad(signals, ((2, 2), (0, 0)), mode="edge")
        return binary_opening(longer, np.ones((3, 1)))[2:-2]

    np.testing.assert_array_equal(metrics.stance(10.0 * down), opened(~opened(~down)))


def test_a_contact_cut_in_two_is_one() -> None:
    step = np.arange(60)
    force = np.where((step >= 20) & (step < 25) & (step != 22), 10.0, 0.0)[:, None]
    assert metrics.stance(force)[:, 0].nonzero()[0].tolist() == [20, 21, 22, 23, 24]


def test_short_contacts_at_the_ends_may_be_parts_of_longer_ones() -> None:
    step = np.arange(60)
    force = np.where((step < 1) | (step >= 59) | ((step > 20) & (step < 40)), 10.0, 0.0)[:, None]
    assert metrics.stance(force)[[0, -1], 0].all()


def test_without_load_nothing_stands() -> None:
    assert not metrics.stance(np.zeros((60, 4))).any()
    assert not metrics.stance(np.full((60, 4), -1.0)).any()
    assert metrics.stance(np.zeros((0, 4))).shape == (0, 4)
