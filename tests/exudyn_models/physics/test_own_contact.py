"""The compiled contact against Exudyn's own: the same robot stands and steps the same way."""

from __future__ import annotations

import numpy as np
import pytest

from apnc_plant.ground import Ground, Kerb, Plane, Surface
from apnc_plant.options import PlantOptions
from apnc_plant.robot import load_robot
from exudyn_models.plant import Plant

LAWS = ("compiled", "exudyn")
ROBOT = load_robot("lilibot")


def standing(contact: str) -> tuple[np.ndarray, float]:
    """Vertical foot forces [N] and height [m] after three seconds at rest."""
    plant = Plant(ROBOT, options=PlantOptions(contact=contact))
    for _ in range(180):
        plant.advance(np.zeros(4), np.zeros(4), 1 / 60)
    sample = plant.sample()
    return sample["foot_force"][:, 2], float(sample["position"][2])


def test_a_robot_at_rest_carries_its_weight_under_both() -> None:
    compiled, own = standing("compiled"), standing("exudyn")
    for force, _ in (compiled, own):
        assert force.sum() == pytest.approx(ROBOT.weight, rel=1e-3)
    # how four stiff feet share the weight depends on the sideways creep; the height does not
    assert own[1] == pytest.approx(compiled[1], abs=2e-5)


def test_an_open_loop_trot_gets_as_far_under_both() -> None:
    diagonal, ends = np.array([1.0, -1.0, -1.0, 1.0]), []
    for law in LAWS:
        plant = Plant(ROBOT, options=PlantOptions(contact=law))
        for tick in range(360):
            phase = 0.12 * tick
            hip = 0.13 * np.sin(phase) * diagonal - 0.111
            knee = 0.08 * np.cos(phase) * diagonal - 0.039
            plant.advance(hip, knee, 1 / 60)
        ends.append(plant.sample()["position"][0])
        assert not plant.fell
    assert ends[1] == pytest.approx(ends[0], rel=0.2)


@pytest.mark.parametrize("ground", [Ground(roughness=0.5), Plane(slope=0.1), Kerb()], ids=repr)
def test_own_contact_is_for_level_smooth_ground(ground: Surface) -> None:
    with pytest.raises(ValueError, match="level ground without obstacles only"):
        Plant(ROBOT, options=PlantOptions(contact="exudyn"), ground=ground)


def test_own_contact_takes_a_ground_without_obstacles() -> None:
    Plant(ROBOT, options=PlantOptions(contact="exudyn"), ground=Ground(roughness=0.0))


def test_unknown_contact_is_named() -> None:
    with pytest.raises(ValueError, match="contact 'glue' is not one of compiled, exudyn"):
        Plant(ROBOT, options=PlantOptions(contact="glue"))
