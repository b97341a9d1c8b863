"""Both criteria of convergence on phases that move in a known way."""

from __future__ import annotations

import numpy as np
import pytest
from records import RATE, TRIPOD, TROT, outputs, steady, synthetic_record

from apnc import metrics

PI = np.pi
WEIGHT = 2.5 * 9.81


@pytest.mark.parametrize("n", [4, 6, 8])
def test_legs_that_stand_still_have_touched(n: int) -> None:
    even = np.full((3, n), WEIGHT / n)
    assert metrics.touch_moment(even, WEIGHT) == 0
    assert metrics.touch_moment(0.79 * even, WEIGHT) is None


def test_touch_moment_needs_two_feet() -> None:
    force = np.zeros((5, 4))
    force[1, 0] = force[2, :2] = WEIGHT / 5
    force[3, 0] = force[4, :2] = WEIGHT / 5 + 0.01
    assert metrics.touch_moment(force, WEIGHT) == 4
    assert metrics.touch_moment(force[:4], WEIGHT) is None
    force[3, 2] = WEIGHT
    assert metrics.touch_moment(force, WEIGHT) == 3


def test_phase_error_is_the_largest() -> None:
    _, o1, o2 = steady((PI - 0.1, -PI + 0.3, 0.2))
    assert metrics.phase_error(o1, o2, TROT) == pytest.approx(0.3)
    _, o1, o2 = steady((PI + 0.1, PI, -0.5))
    assert metrics.phase_error(o1, o2, TROT) == pytest.approx(0.5)
    walk = (PI / 2, PI, -PI / 2)
    assert metrics.phase_error(*steady(walk)[1:], walk) == pytest.approx(0.0, abs=1e-9)


def test_trot_from_the_start_converges_at_once() -> None:
    t, o1, o2 = steady(TROT)
    assert metrics.convergence_time(t, o1, o2, 30, TROT) == 0.0
    assert metrics.convergence_time_authors(t, o1, o2, 30, TROT) == 0.0


@pytest.mark.parametrize("phases", [(0, 0, 0), (PI, PI, 0.7), (PI, PI - 0.7, 0), (0, PI, PI)])
def test_other_gaits_are_not_a_trot(phases: tuple[float, ...]) -> None:
    t, o1, o2 = steady(phases)
    assert metrics.convergence_time(t, o1, o2, 0, TROT) is None


@pytest.mark.parametrize(
    ("phases", "formed"), [((PI, PI - 0.59, 0), 0.0), ((PI + 0.61, PI, 0), None)]
)
def test_tolerance_of_the_strict_criterion(phases: tuple[float, ...], formed: float | None) -> None:
    t, o1, o2 = steady(phases)
    assert metrics.convergence_time(t, o1, o2, 0, TROT) == formed


@pytest.mark.parametrize(("apart", "formed"), [(2.79, 0.0), (2.81, None)])
def test_threshold_of_the_authors_criterion(apart: float, formed: float | None) -> None:
    t, o1, o2 = steady((PI, PI, apart))
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) == formed
    # It is the Euclidean distance that counts, with a root sum of squares of the same 2.8 rad.
    each = apart / np.sqrt(3)
    t, o1, o2 = steady((PI - each, PI + each, -each))
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) == formed


def test_a_dip_within_a_cycle_does_not_meet_the_authors_criterion() -> None:
    t = np.arange(600) / RATE
    # 2.9 rad apart in the mean, 2.7 to 3.1 rad within a fifth of a second.
    lead = np.stack([0 * t, 0 * t + PI, 0 * t + PI, 2.9 + 0.2 * np.sin(2 * PI * 5 * t)], axis=1)
    o1, o2 = outputs(10 * t[:, None] + lead)
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) is None


def test_in_phase_does_not_meet_the_authors_criterion() -> None:
    t, o1, o2 = steady((0.0, 0.0, 0.0))
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) is None


def test_convergence_times_of_a_ramp() -> None:
    r = synthetic_record(20.0, formation=(2.0, 12.0))
    o1, o2 = r.signals["o1"], r.signals["o2"]
    # phi13 enters the band at pi - 0.6; the distance sqrt(2) (pi - x) is 2.8 at x = pi - 1.98.
    strict, authors = 2 + 10 * (PI - 0.6) / PI, 2 + 10 * (PI - 2.8 / np.sqrt(2)) / PI
    for touch in (0, 60):
        found = metrics.convergence_time(r.time, o1, o2, touch, TROT)
        assert found == pytest.approx(strict - touch / RATE, abs=0.05)
        found = metrics.convergence_time_authors(r.time, o1, o2, touch, TROT)
        assert found == pytest.approx(authors - touch / RATE, abs=0.05)


def test_the_strict_time_is_that_of_the_first_sample_inside() -> None:
    r = synthetic_record(20.0, formation=(2.0, 12.0))
    o1, o2 = r.signals["o1"], r.signals["o2"]
    found = metrics.convergence_time(r.time, o1, o2, 0, TROT)
    assert found is not None
    first = round(found * RATE)
    error = metrics.phase_error(o1, o2, TROT)
    assert error[first - 1] > 0.6 >= error[first]


def test_a_gait_that_was_there_before_the_touch_counts_from_it() -> None:
    r = synthetic_record(20.0, formation=(2.0, 4.0))
    o1, o2 = r.signals["o1"], r.signals["o2"]
    assert metrics.convergence_time(r.time, o1, o2, 600, TROT) == 0.0
    assert metrics.convergence_time_authors(r.time, o1, o2, 600, TROT) == 0.0


def test_time_counts_in_seconds_of_the_time_axis() -> None:
    r = synthetic_record(20.0, formation=(2.0, 12.0))
    o1, o2 = r.signals["o1"], r.signals["o2"]
    for criterion in (metrics.convergence_time, metrics.convergence_time_authors):
        once, twice = (criterion(k * r.time + 7.0, o1, o2, 60, TROT) for k in (1, 2))
        assert once and twice == pytest.approx(2 * once)


def test_a_trot_that_is_lost_again_does_not_count() -> None:
    t, o1, o2 = steady(TROT, 20.0)
    _, p1, p2 = steady((PI, PI, 1.5), 20.0)
    late = t > 15
    o1[late], o2[late] = p1[late], p2[late]
    assert metrics.convergence_time(t, o1, o2, 0, TROT) is None
    assert metrics.convergence_time_authors(t, o1, o2, 0, TROT) == 0.0


def test_an_excursion_moves_the_strict_time_to_after_it() -> None:
    t = np.arange(1200) / RATE
    away = np.where((t > 6) & (t < 10), 1.5, 0.0)
    o1, o2 = outputs(10 * t[:, None] + np.array([0, PI, PI, 0]) + away[:, None] * [0, 0, 0, 1])
    found = metrics.convergence_time(t, o1, o2, 0, TROT)
    assert found == pytest.approx(10.0, abs=0.2)


@pytest.mark.parametrize(("end", "formed"), [(8.8, True), (9.3, False)])
def test_the_gait_must_last_for_a_second(end: float, formed: bool) -> None:
    r = synthetic_record(10.0, formation=(end - 0.3, end))
    o1, o2 = r.signals["o1"], r.signals["o2"]
    assert (metrics.convergence_time(r.time, o1, o2, 0, TROT) is not None) is formed


def test_a_touch_in_the_last_second_is_too_late() -> None:
    t, o1, o2 = steady(TROT)
    assert metrics.convergence_time(t, o1, o2, 600 - 61, TROT) == 0.0
    assert metrics.convergence_time(t, o1, o2, 600 - 60, TROT) is None


def test_never_on_the_ground_never_converged() -> None:
    t, o1, o2 = steady(TROT)
    assert metrics.convergence_time(t, o1, o2, None, TROT) is None
    assert metrics.convergence_time_authors(t, o1, o2, None, TROT) is None


def test_a_resting_oscillator_has_not_converged() -> None:
    t, o1, o2 = steady(TROT)
    assert metrics.convergence_time(t, 0 * o1, 0 * o2, 0, TROT) is None


def test_target_of_the_wrong_length_is_refused() -> None:
    t, o1, o2 = steady(TROT)
    for criterion in (metrics.convergence_time, metrics.convergence_time_authors):
        with pytest.raises(ValueError, match=r"^target \[3\.14.*\] does not have 3 phases$"):
            criterion(t, o1, o2, 0, TRIPOD)


@pytest.mark.parametrize(
    ("touch", "expected"), [(0, 4.0), (90, 2.5), (300, 0.0), (539, 0.0), (540, None), (None, None)]
)
def test_an_error_settles_when_it_stays_within_the_tolerance(
    touch: int | None, expected: float | None
) -> None:
    time = np.arange(600) / RATE
    error = np.where((time < 1.0) | ((time >= 2.0) & (time < 4.0)), 0.61, 0.59)
    assert metrics.settling_time(time, error, touch) == expected
