"""The closed loop under our contact and under MuJoCo's own: the trot forms alike."""

from __future__ import annotations

import pytest

from apnc.features import walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc_plant.options import PlantOptions


def test_the_trot_forms_under_mujocos_contact_as_under_ours() -> None:
    pytest.importorskip("mujoco")
    import own_contact_mujoco  # noqa: PLC0415

    run = Experiment(mi=0.15, seed=1, duration=12.0, engine="mujoco")
    options = PlantOptions(step=run.step)
    plant = own_contact_mujoco.Plant(run.description, run.seed, options=options)
    ours, its = (walk_features(simulate(run, plant=own)) for own in (None, plant))
    assert ours.converged and its.converged
    assert ours.gait == its.gait == "trot"
    assert its.stride_frequency_hz == pytest.approx(ours.stride_frequency_hz, rel=0.1)
