"""A walk keeps in step with the clock, and tells how far it falls behind."""

from __future__ import annotations

import math

import pytest

from apnc.view.pace import SLICE, Pace

TS = 1 / 60


class Clock:
    """Time passes by sleeping, and by the work of a tick."""

    def __init__(self) -> None:
        self.now = 100.0
        self.slept: list[float] = []

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds


def walked(speed: float, work: float, ticks: int = 600) -> tuple[Pace, Clock]:
    """A walk whose ticks take a time to compute [s]."""
    clock = Clock()
    pace = Pace(speed, clock, clock.sleep)
    for n in range(ticks):
        pace.wait(n * TS)
        clock.now += work
    return pace, clock


@pytest.mark.parametrize("speed", [0.25, 1.0, 4.0])
def test_a_fast_engine_keeps_the_speed_that_is_asked_for(speed: float) -> None:
    pace, clock = walked(speed, 0.0005)
    assert clock.now - 100.0 == pytest.approx(599 * TS / speed, abs=0.01)
    assert pace.measured == pytest.approx(speed, rel=0.01)
    assert pace.behind == pytest.approx(0.0, abs=1e-9)


def test_a_slow_engine_never_waits_and_its_delay_adds_up() -> None:
    pace, clock = walked(1.0, 0.05)
    assert clock.slept == []
    assert pace.behind == pytest.approx(599 * (0.05 - TS), rel=1e-6)
    assert pace.measured == pytest.approx(TS / 0.05, rel=1e-6)


def test_after_a_stall_it_does_not_race_and_the_stall_stays_told() -> None:
    clock = Clock()
    pace = Pace(1.0, clock, clock.sleep)
    for n in range(300):
        if n == 100:
            clock.now += 2.0
        before = clock.now
        pace.wait(n * TS)
        if n > 110:
            assert clock.now - before > 0.5 * TS
    assert pace.behind == pytest.approx(2.0 - TS, abs=0.06)


def test_as_fast_as_it_goes_is_never_behind() -> None:
    pace, clock = walked(math.inf, 0.05)
    assert clock.slept == [] and pace.behind == 0.0


def test_another_speed_holds_at_once_and_a_pause_is_no_delay() -> None:
    clock = Clock()
    pace = Pace(1.0, clock, clock.sleep)
    for n in range(60):
        pace.wait(n * TS)
    pace.speed, begin = 2.0, clock.now
    for n in range(60, 121):
        pace.wait(n * TS)
    assert clock.now - begin == pytest.approx(60 * TS / 2.0, abs=1e-6)
    clock.now += 30.0
    pace.restart()
    pace.wait(121 * TS)
    assert pace.behind == pytest.approx(0.0, abs=1e-9)


def test_a_stop_ends_a_long_wait() -> None:
    clock = Clock()
    pace = Pace(0.01, clock, clock.sleep)
    pace.wait(0.0)
    pace.wait(10.0, stop=lambda: clock.now > 100.5)
    assert clock.now < 100.5 + 2 * SLICE
