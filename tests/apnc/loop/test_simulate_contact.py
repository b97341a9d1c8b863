"""The closed loop under our contact and under the engines' own: the trot forms alike."""

from __future__ import annotations

import own_contact_exudyn
import pytest

from apnc.features import WalkFeatures, walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc_plant.legged import LeggedPlant
from apnc_plant.options import PlantOptions


def walked(experiment: Experiment, kind: type[LeggedPlant] | None = None) -> WalkFeatures:
    """What is measured of a walk, in a plant of this kind if one is given."""
    options = PlantOptions(step=experiment.step)
    plant = kind and kind(experiment.description, experiment.seed, options=options)
    return walk_features(simulate(experiment, plant=plant))


def test_the_trot_forms_under_exudyns_contact_as_under_ours() -> None:
    run = Experiment(mi=0.08, duration=20)
    ours, its = walked(run), walked(run, own_contact_exudyn.Plant)
    for summary in (ours, its):
        assert summary.converged and not summary.fell
    assert its.path_speed_m_per_s == pytest.approx(ours.path_speed_m_per_s, rel=0.2)
    assert its.stride_frequency_hz == pytest.approx(ours.stride_frequency_hz, rel=0.1)


def test_the_trot_forms_under_mujocos_contact_as_under_ours() -> None:
    pytest.importorskip("mujoco")
    import own_contact_mujoco  # noqa: PLC0415

    run = Experiment(mi=0.15, seed=1, duration=12.0, engine="mujoco")
    ours, its = walked(run), walked(run, own_contact_mujoco.Plant)
    assert ours.converged and its.converged
    assert ours.gait == its.gait == "trot"
    assert its.stride_frequency_hz == pytest.approx(ours.stride_frequency_hz, rel=0.1)
