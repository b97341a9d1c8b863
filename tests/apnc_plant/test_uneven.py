"""The robot on grounds that are not flat: what carries it, and where its feet come to rest."""

import numpy as np
import pytest
from plants import AnyPlant, Kind, in_both

from apnc_plant.ground import Ground, Kerb, Waves
from apnc_plant.robot import load_robot

TICK = 1 / 60
ROBOT = load_robot("lilibot")


def settled(kind: Kind, ground: Ground) -> AnyPlant:
    plant = kind(ROBOT, ground=ground)
    for _ in range(120):
        plant.advance(np.zeros(4), np.zeros(4), TICK)
    return plant


@in_both
def test_front_feet_stand_on_a_kerb_and_hind_feet_below_it(kind: Kind) -> None:
    plant = settled(kind, Kerb(at=0.0, height=0.006))
    sample = plant.sample()
    foot, force = sample["foot_position"], sample["foot_force"]
    assert force[:, 2].sum() == pytest.approx(ROBOT.weight, rel=1e-3)
    assert force[:, 2].min() > 1.0
    step = np.array([0.006, 0.0, 0.006, 0.0])
    sunk = step + ROBOT.contact.foot_radius - foot[:, 2]
    np.testing.assert_allclose(sunk, force[:, 2] / ROBOT.contact.stiffness, rtol=0.01)
    assert not plant.fell


@in_both
def test_on_waves_feet_stand_at_the_height_of_the_waves(kind: Kind) -> None:
    waves = Waves(amplitude=0.005, wavelength=0.3)
    plant = settled(kind, waves)
    sample = plant.sample()
    assert sample["foot_force"][:, 2].sum() == pytest.approx(ROBOT.weight, rel=5e-3)
    for (x, y, z), force in zip(sample["foot_position"], sample["foot_force"], strict=True):
        ((*normal, depth),) = waves.contacts((x, y, z), ROBOT.contact.foot_radius)
        pressed = ROBOT.contact.stiffness * depth
        assert force @ normal == pytest.approx(pressed, rel=0.05)
    assert not plant.fell


@in_both
def test_a_walk_goes_over_a_kerb(kind: Kind) -> None:
    plant = kind(ROBOT, ground=Kerb(at=0.14, height=0.004))
    diagonal = np.array([1.0, -1.0, -1.0, 1.0])
    for tick in range(480):
        phase = 0.12 * tick
        hip = 0.13 * np.sin(phase) * diagonal - 0.111
        knee = 0.12 * np.cos(phase) * diagonal - 0.039
        plant.advance(hip, knee, TICK)
    for _ in range(60):
        plant.advance(np.full(4, -0.111), np.full(4, -0.039), TICK)
    foot = plant.sample()["foot_position"]
    assert (foot[:, 0] > 0.16).all()
    assert (foot[:, 2] > 0.004 + ROBOT.contact.foot_radius - 0.002).all()
    assert not plant.fell
