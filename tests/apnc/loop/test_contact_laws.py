"""The closed loop under the compiled contact and under Exudyn's own: the trot forms alike."""

from __future__ import annotations

import pytest

from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc.summary import summarise


def test_the_trot_forms_under_both_and_walks_alike() -> None:
    figures = [
        summarise(simulate(Experiment(mi=0.08, duration=20, contact=law)))
        for law in ("compiled", "exudyn")
    ]
    for figure in figures:
        assert figure.converged and not figure.fell
    speeds = [figure.path_speed_m_per_s or 0.0 for figure in figures]
    strides = [figure.stride_frequency_hz or 0.0 for figure in figures]
    assert speeds[1] == pytest.approx(speeds[0], rel=0.2)
    assert strides[1] == pytest.approx(strides[0], rel=0.1)
