"""A long run is thinned to what a browser can draw; its peaks and its end stay."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from records import synthetic_record

from apnc.features import walk_features
from apnc.report.page import render
from apnc.report.samples import LATE_S, SHOWN, Samples


def test_a_short_run_is_shown_whole() -> None:
    time = np.arange(SHOWN) / 60.0
    samples = Samples(time)
    assert samples.opens_at is None
    assert np.array_equal(samples.at, np.arange(SHOWN))
    assert np.array_equal(samples.of(time), time)


@pytest.mark.parametrize("count", [SHOWN + 1, 54_321, 216_000])
def test_a_long_run_keeps_its_peaks_and_its_end(count: int) -> None:
    time = np.arange(count) / 60.0
    values = np.random.default_rng(0).normal(size=count)
    values[1234], values[4321] = 50.0, -50.0
    samples = Samples(time)
    shown, late = samples.of(values), round(60 * LATE_S)
    assert len(shown) == len(samples.at) <= SHOWN + late + samples.block
    assert np.array_equal(shown[-late:], values[-late:])
    assert samples.opens_at is not None
    assert time[samples.opens_at] == pytest.approx(time[-1] - LATE_S, abs=samples.block / 60.0)
    for peak in (1234, 4321):
        near = np.abs(samples.at - peak) < samples.block
        assert values[peak] in shown[near]
    for index, begin in enumerate(range(0, samples.opens_at, samples.block)):
        block = values[begin : begin + samples.block]
        assert sorted(shown[2 * index : 2 * index + 2]) == [block.min(), block.max()]


def test_thinned_lines_rise_where_the_signal_rises() -> None:
    count = 4 * SHOWN
    ramp = np.arange(count) / 60.0
    samples = Samples(ramp)
    assert np.all(np.diff(samples.of(ramp)) > 0)
    assert np.all(np.diff(samples.of(-ramp)) < 0)


def test_undefined_samples_leave_no_hole_in_a_block() -> None:
    values = np.full(4 * SHOWN, np.nan)
    values[::5] = 1.0
    samples = Samples(np.arange(len(values)) / 60.0)
    assert samples.block >= 5
    assert np.nanmax(samples.of(values)[: samples.opens_at // samples.block]) == 1.0
    assert not np.isnan(samples.of(values)[: samples.opens_at // samples.block]).any()


def test_the_report_of_an_hour_is_small_and_says_that_it_is_thinned() -> None:
    minute = synthetic_record(60.0)
    hour = replace(
        minute,
        time=np.arange(60 * len(minute)) / 60.0,
        signals={k: np.concatenate([v] * 60) for k, v in minute.signals.items()},
    )
    text = render(hour, walk_features(hour))
    assert len(text) < 30e6
    assert "This run is long." in text
    assert '"opensAt":3589.' in text
