"""Robots with other legs than the shipped ones, in a closed loop."""

from __future__ import annotations

import pytest
from made_up_robots import insect, x_pose

import apnc


@pytest.mark.parametrize("mi", [0.1, 0.12, 0.15])
def test_a_quadruped_in_an_x_pose_forms_and_keeps_a_trot(mi: float) -> None:
    experiments = [
        apnc.Experiment(robot=x_pose(), mi=mi, seed=seed, engine="compiled") for seed in range(4)
    ]
    found = list(apnc.simulate_many(experiments))
    assert [walk.gait for walk in found] == ["trot"] * 4
    assert not any(walk.fell for walk in found)


def test_a_hexapod_with_coxae_walks_in_a_tripod() -> None:
    experiments = [
        apnc.Experiment(robot=insect(), mi=0.12, seed=seed, engine="compiled") for seed in range(3)
    ]
    found = list(apnc.simulate_many(experiments))
    assert [walk.gait for walk in found] == ["tripod"] * 3
    assert all((walk.forward_speed_m_per_s or 0.0) > 0.05 for walk in found)
