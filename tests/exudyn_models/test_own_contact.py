"""Our contact against Exudyn's own: the same robot stands and steps the same way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import own_contact_exudyn
import pytest
from plain_robot import plain_robot
from plants import commands

from apnc_plant.legged import LeggedPlant
from apnc_plant.options import PlantOptions
from apnc_plant.robot import load_robot
from exudyn_models.plant import ExudynPlant

ROBOT = load_robot("lilibot")
PLANTS = (ExudynPlant, own_contact_exudyn.Plant)
TICK = 1 / 60


def standing(plant: LeggedPlant) -> tuple[np.ndarray, float]:
    """Vertical foot forces [N] and height [m] after three seconds at rest."""
    for _ in range(180):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    sample = plant.sample()
    return sample["foot_force"][:, 2], float(sample["position"][2])


def test_a_robot_at_rest_carries_its_weight_under_both() -> None:
    ours, its = (standing(kind(ROBOT)) for kind in PLANTS)
    for force, _ in (ours, its):
        assert force.sum() == pytest.approx(ROBOT.weight, rel=1e-3)
    # how four stiff feet share the weight depends on the sideways creep; the height does not
    assert its[1] == pytest.approx(ours[1], abs=2e-5)


def forces_in_a_trot(plant: LeggedPlant, steps: int) -> np.ndarray:
    """Mean force on every foot in every tick of a trot on fixed phases [N], (ticks, n_legs, 3)."""
    forces = []
    for tick in range(60):
        for _ in range(steps):
            plant.advance(*commands(tick), TICK / steps)
            forces.append(plant.sample()["foot_force"])
    return np.reshape(forces, (60, steps, 4, 3)).mean(axis=1)


@pytest.mark.thorough
def test_where_both_laws_are_the_same_a_trot_feels_the_same_forces() -> None:
    # damping from first touch on, as Exudyn has it, needs a fine step: at 16 steps a tick the
    # forces are 5, 10 and 2 % apart, at 64 they are 0.9, 1.8 and 0.7 %, at 256 0.8, 0.7 and 0.2 %
    steps = 64
    robot = plain_robot()
    sudden = replace(robot, contact=replace(robot.contact, damping_depth=1e-6))
    options = PlantOptions(step=TICK / steps)
    ours, its = (forces_in_a_trot(kind(sudden, options=options), steps) for kind in PLANTS)
    apart = np.sqrt(((ours - its) ** 2).mean(axis=(0, 1)) / (its**2).mean(axis=(0, 1)))
    # a friction 5 % off, or a damping or stiffness 10 to 20 % off, is beyond one of these
    assert (apart < [0.02, 0.025, 0.012]).all(), apart
