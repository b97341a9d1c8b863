"""The search loop with MuJoCo's rollout walks the same robots upright."""

from __future__ import annotations

from contextlib import ExitStack

import numpy as np
import pytest

from apnc import metrics
from apnc.loop.batch import fmu_of
from apnc.loop.fmu_controller import FmuController
from apnc.many import simulate_many
from benchmarks.command import Size
from benchmarks.tune import KINDS, Loops, generation, start_of


def test_robots_in_mujoco_walk_upright_in_their_closed_loops() -> None:
    plan = generation(start_of("lilibot"), Size(quick=True, duration=9.0))
    runs = [task.experiment for task in plan[0] if task.kind in KINDS][-3:]
    assert len({run.description for run in runs}) > 1  # bodies differ
    with ExitStack() as open_:
        controllers = [
            open_.enter_context(FmuController(fmu_of(run), run.starts())) for run in runs
        ]
        states = Loops(runs, "Euler", 32).walk(controllers, threads=1)
        phases = np.array([controller.phi.copy() for controller in controllers])
    assert states[:, 0] == pytest.approx(9.0)
    assert np.abs(metrics.wrap(phases - np.array(metrics.GAITS[4]["trot"]))).max() < 0.6
    for state, record in zip(states, simulate_many(runs, records=True), strict=True):
        assert record is not None and record.complete
        assert state[1] > 0.3 and record.signals["position"][-1, 0] > 0.3  # m
        assert state[3] == pytest.approx(record.signals["position"][-1, 2], abs=0.02)
