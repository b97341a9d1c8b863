"""The compiled contact against Exudyn's own: the same robot stands and walks the same way."""

from __future__ import annotations

import numpy as np
import pytest
from apnc.loop.recording import Record
from apnc.loop.walk import WalkOptions, walk

from apnc.summary import summarise
from build_fmu.build import host_fmu
from exudyn_models.ground import Ground
from exudyn_models.physics.options import PlantOptions
from exudyn_models.physics.plant import Plant
from exudyn_models.robot import load_robot

LAWS = ("compiled", "exudyn")


def standing(contact: str) -> tuple[np.ndarray, float]:
    """Vertical foot forces [N] and height [m] after three seconds at rest."""
    plant = Plant(load_robot("lilibot"), options=PlantOptions(contact=contact))
    for _ in range(180):
        plant.advance(np.zeros(4), np.zeros(4), 1 / 60)
    sample = plant.sample()
    return sample["foot_force"][:, 2], float(sample["position"][2])


def test_a_robot_at_rest_carries_its_weight_under_both() -> None:
    weight = load_robot("lilibot").weight
    compiled, own = standing("compiled"), standing("exudyn")
    for force, _ in (compiled, own):
        assert force.sum() == pytest.approx(weight, rel=1e-3)
    # how four stiff feet share the weight depends on the sideways creep; the height does not
    assert own[1] == pytest.approx(compiled[1], abs=2e-5)


def trot(contact: str) -> Record:
    return walk(WalkOptions(mi=0.08, duration=20, contact=contact), host_fmu())


def test_the_trot_forms_under_both_and_walks_alike() -> None:
    figures = [summarise(trot(law), method="apnc", mi=0.08, seed=0) for law in LAWS]
    for figure in figures:
        assert figure.converged and not figure.fell
    speeds = [figure.path_speed_m_per_s or 0.0 for figure in figures]
    strides = [figure.stride_frequency_hz or 0.0 for figure in figures]
    assert speeds[1] == pytest.approx(speeds[0], rel=0.2)
    assert strides[1] == pytest.approx(strides[0], rel=0.1)


def test_own_contact_is_for_level_smooth_ground() -> None:
    with pytest.raises(ValueError, match="level ground without obstacles only"):
        Plant(
            load_robot("lilibot"),
            options=PlantOptions(contact="exudyn"),
            ground=Ground(roughness=0.5),
        )


def test_unknown_contact_is_named() -> None:
    with pytest.raises(ValueError, match="contact 'glue' is not one of compiled, exudyn"):
        PlantOptions(contact="glue")
