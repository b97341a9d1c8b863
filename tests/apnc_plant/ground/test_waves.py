"""Contacts with waves against closed form and against a search, and robots on them."""

import math

import numpy as np
import pytest
from plants import Kind, in_both, settled

from apnc_plant.ground import Waves
from apnc_plant.robot import load_robot

R, A, L = 0.012, 0.006, 0.2
ROBOT = load_robot("lilibot")
WAVES = Waves(amplitude=A, wavelength=L)


def test_height_is_the_sum_of_two_sines() -> None:
    assert WAVES.elevation(np.array(L / 4), np.array(L / 4)) == pytest.approx(A)
    assert WAVES.elevation(np.array(3 * L / 4), np.array(L / 4)) == pytest.approx(0.0, abs=1e-15)
    assert WAVES.elevation(np.array(-L / 4), np.array(3 * L / 4)) == pytest.approx(-A)
    assert WAVES.elevation(np.array(L / 12), np.array(5 * L)) == pytest.approx(A / 4)
    assert WAVES.top == A


@pytest.mark.parametrize(("x", "height"), [(L / 4, A), (3 * L / 4, -A)])
def test_on_crests_and_in_troughs_the_ball_stands_upright(x: float, height: float) -> None:
    found = WAVES.contacts((x, x, height + R - 0.001), R)
    np.testing.assert_allclose(found, [[0, 0, 1, 0.001]], atol=1e-12)
    assert WAVES.rest_height(x, x, R) == pytest.approx(height + R, abs=1e-12)


@pytest.mark.parametrize("waves", [WAVES, Waves(amplitude=0.025, wavelength=0.3)], ids=repr)
def test_the_depth_is_that_of_the_nearest_point(waves: Waves) -> None:
    # A grid around the ball, refined until it is finer than the tolerance.
    random = np.random.default_rng(3)
    for _ in range(40):
        x, y = random.uniform(-0.5, 0.5, 2)
        z = waves.rest_height(x, y, R) - random.uniform(0.0, 0.002)
        centre, span = (x, y), 2 * R
        for _ in range(8):
            u = centre[0] + np.linspace(-span, span, 41)[:, None]
            v = centre[1] + np.linspace(-span, span, 41)
            squares = (u - x) ** 2 + (v - y) ** 2 + (waves.elevation(u, v) - z) ** 2
            i, j = np.unravel_index(squares.argmin(), squares.shape)
            centre, span = (u[i, 0], v[j]), span / 8
        nearest = np.array([*centre, waves.elevation(np.array(centre[0]), np.array(centre[1]))])
        away = np.array([x, y, z]) - nearest
        (found,) = waves.contacts((x, y, z), R)
        assert found[3] == pytest.approx(R - np.linalg.norm(away), abs=1e-9)
        np.testing.assert_allclose(found[:3], away / np.linalg.norm(away), atol=2e-4)


def test_a_ball_that_would_touch_at_two_places_is_refused() -> None:
    tight = Waves(amplitude=0.005, wavelength=0.04)
    with pytest.raises(ValueError, match=r"amplitude is 0.005; allowed: up to 0\.00\d+ at this"):
        tight.contacts((0.0, 0.0, 0.0), R)
    curvature = 0.005 / 2 * (2 * math.pi / 0.04) ** 2
    assert len(tight.contacts((0.0, 0.0, 0.0), 0.49 / curvature)) == 1


@in_both
def test_on_waves_feet_stand_at_the_height_of_the_waves(kind: Kind) -> None:
    waves = Waves(amplitude=0.005, wavelength=0.3)
    plant = settled(kind, waves, ROBOT)
    sample = plant.sample()
    assert sample["foot_force"][:, 2].sum() == pytest.approx(ROBOT.weight, rel=5e-3)
    for (x, y, z), force in zip(sample["foot_position"], sample["foot_force"], strict=True):
        ((*normal, depth),) = waves.contacts((x, y, z), ROBOT.contact.foot_radius)
        pressed = ROBOT.contact.stiffness * depth
        assert force @ normal == pytest.approx(pressed, rel=0.05)
    assert not plant.fell
